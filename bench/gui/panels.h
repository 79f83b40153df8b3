#pragma once

namespace hlodbench {

class Viewer;

// The panel at the window's left, `width` pixels wide, and what else lies over the view.
void showPanels(Viewer& viewer, float width);

// Its parts, each in its own file.
void showStrategyPanel(Viewer& viewer);
void showCounterPanel(Viewer& viewer);
void showLookPanel(Viewer& viewer);
void showSessionPanel(Viewer& viewer);
// Questions that must be answered: of a session of another scene, of an interrupted recording.
void showQuestions(Viewer& viewer);
void showHelp(Viewer& viewer);

}  // namespace hlodbench
