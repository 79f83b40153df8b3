#include "hlod/view/camera.h"

#include <glm/gtc/matrix_transform.hpp>

namespace hlodbench {

Camera makeCamera(const Lens& lens, const Pose& pose) {
  const double aspect = static_cast<double>(lens.width) / lens.height;
  const glm::dmat4 projection =
      glm::perspective(lens.fovyRad, aspect, lens.nearPlane, lens.farPlane);
  const glm::dmat4 worldToCamera = glm::mat4_cast(glm::conjugate(pose.orientation)) *
                                   glm::translate(glm::dmat4(1.0), -pose.position);
  return {lens, pose, projection * worldToCamera};
}

}  // namespace hlodbench
