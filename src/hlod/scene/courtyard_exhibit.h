#pragma once

#include <string>
#include <vector>

#include "hlod/scene/courtyard_body.h"
#include "hlod/scene/courtyard_random.h"

// Bodies with their pedestals and colours, ready to stand somewhere.
namespace hlodbench::courtyard {

// Each adds one or two objects named after `name`, standing at the placement.
void addSculpture(const std::string& name, int kind, double pedestalHeight, const Placement& at,
                  Random& random, std::vector<ObjectPlan>& plans);
void addVase(const std::string& name, const Placement& at, Random& random,
             std::vector<ObjectPlan>& plans);
void addPlanter(const std::string& name, const Placement& at, Random& random,
                std::vector<ObjectPlan>& plans);

// One of the above, drawn by lot; sculptures are twice as likely as the others together.
void addExhibit(const std::string& name, const Placement& at, Random& random,
                std::vector<ObjectPlan>& plans);

}  // namespace hlodbench::courtyard
