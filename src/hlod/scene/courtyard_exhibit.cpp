#include "hlod/scene/courtyard_exhibit.h"

#include "hlod/scene/courtyard_palette.h"
#include "hlod/scene/courtyard_plants.h"
#include "hlod/scene/courtyard_sculpture.h"
#include "hlod/scene/courtyard_vessels.h"

namespace hlodbench::courtyard {
namespace {

constexpr double kPedestalDetail = 3.0;
constexpr double kVesselDetail = 3.6;
constexpr double kBushDetail = 3.6;

}  // namespace

void addSculpture(const std::string& name, int kind, double pedestalHeight, const Placement& at,
                  Random& random, std::vector<ObjectPlan>& plans) {
  const glm::vec3 stone = pickColor(Material::kColumn, random);
  // Figures are of marble; the other forms may be of marble, bronze or glazed ware.
  static constexpr Material kMaterials[] = {Material::kMarble, Material::kBronze,
                                            Material::kCeramic, Material::kBronze};
  const Material material = kind == 0 ? Material::kMarble : kMaterials[random.below(4)];
  const glm::vec3 color = pickColor(material, random);
  plans.push_back(movedObject(
      {name + " pedestal", stone, {makePedestal(0.72, pedestalHeight, kPedestalDetail)}}, at));
  Placement top = at;
  top.origin.y += at.scale * (pedestalHeight - 0.01);
  plans.push_back(movedObject({name, color, makeSculpture(kind, random)}, top));
}

void addVase(const std::string& name, const Placement& at, Random& random,
             std::vector<ObjectPlan>& plans) {
  const glm::vec3 color = pickColor(Material::kCeramic, random);
  plans.push_back(movedObject({name, color, {makeVase(random, kVesselDetail)}}, at));
}

void addPlanter(const std::string& name, const Placement& at, Random& random,
                std::vector<ObjectPlan>& plans) {
  const glm::vec3 clay = pickColor(Material::kRoof, random);
  plans.push_back(movedObject({name, clay, {makePlanter(random, kVesselDetail)}}, at));
  const glm::vec3 leaf = pickColor(Material::kLeaf, random);
  const Body bush = movedBody(makeBush(0.42, random.next(), kBushDetail), {{0.0, 0.78, 0.0}});
  plans.push_back(movedObject({name + " bush", leaf, {bush}}, at));
}

void addExhibit(const std::string& name, const Placement& at, Random& random,
                std::vector<ObjectPlan>& plans) {
  const int lot = random.below(9);
  if (lot < kSculptureKinds) {
    addSculpture(name, lot, 0.75, at, random, plans);
  } else if (lot < 8) {
    addVase(name, at, random, plans);
  } else {
    addPlanter(name, at, random, plans);
  }
}

}  // namespace hlodbench::courtyard
