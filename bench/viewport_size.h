#pragma once

#include <string>

#include "hlod/view/camera.h"

namespace hlodbench {

// Sets the viewport of the lens from the text of --size, "WIDTHxHEIGHT", pixels; "" leaves it.
// Throws InputError for another form, or a side that is not 1 to 16384.
void applySize(const std::string& size, Lens& lens);

}  // namespace hlodbench
