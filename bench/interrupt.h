#pragma once

namespace hlodbench {

// From now on the first Ctrl-C (or SIGTERM) is only noted, so that what is complete can be written;
// the second one ends the program at once.
void catchInterrupts();
bool isInterrupted();

}  // namespace hlodbench
