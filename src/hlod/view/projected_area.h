#pragma once

#include "hlod/core/aabb.h"
#include "hlod/view/camera.h"

namespace hlodbench {

// True when a corner of the box is no farther along the view direction than the near plane, or the
// eye is inside the box: its projection is not a closed polygon then, and part of its faces is
// clipped away, so that no occlusion query can count its pixels.
bool isCutByNearPlane(const Camera& camera, const Aabb& box);

// Pixels of the viewport that the box covers, 0 to width * height: the denominator of the relative
// visibility mu (paper, section 3.2). The silhouette polygon of the box (Schmalstieg & Tobler, JGT
// 4(2), 1999) is clipped to the viewport, because the occlusion query counts only there.
// The box must not be cut by the near plane (see isCutByNearPlane).
double computeProjectedArea(const Camera& camera, const Aabb& box);

// The same without clipping: what the whole box would cover on an endless screen.
double computeUnclippedArea(const Camera& camera, const Aabb& box);

// The same as computeProjectedArea() for a box that the near plane cuts, of what lies in front of
// the eye: pixels that its front faces cover when they are drawn without clipping at the near plane
// (GL_DEPTH_CLAMP). The eye must be outside of the box.
double computeProjectedAreaOfCutBox(const Camera& camera, const Aabb& box);

}  // namespace hlodbench
