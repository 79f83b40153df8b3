#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hlodbench {

// One row of the paper's Table 1, as printed. Absent where the paper prints a dash.
struct PaperRow {
  std::string strategy;  // our id: "coh-b"
  std::string label;     // the paper's: "Coh(B)"
  double dn = 0.0;       // nodes a frame
  std::optional<double> rarn;
  std::optional<double> d;
  double fps = 0.0;
  std::optional<double> speedup;  // of Coh(B) over this row
};

// Peak signal-to-noise ratio of one colour component over the frames compared, in dB.
struct PaperPsnr {
  double mean = 0.0;
  double stddev = 0.0;
};

struct PaperScene {
  std::string id;             // the name of our scene that stands for it: "scene1"
  std::string label;          // "scene 1"
  double triangles = 0.0;     // approximate
  double nodes = 0.0;         // approximate
  double delayedShare = 0.0;  // D / DN of Coh(B), 0 to 1 (section 5.2)
  std::vector<PaperRow> rows;
  PaperPsnr y, cb, cr;  // Coh(B) against Bool (section 5.3)

  // The row of a strategy, or null.
  [[nodiscard]] const PaperRow* find(const std::string& strategy) const;
};

struct PaperTable {
  std::string title;
  std::string citation;
  std::vector<PaperScene> scenes;

  // The scene with this id, or null.
  [[nodiscard]] const PaperScene* find(const std::string& id) const;
};

// Table 1 of Charalambos, Bittner, Wimmer, Romero (ISVC 2007): results/paper_table1.json, which is
// built into the program.
const PaperTable& paperTable1();

}  // namespace hlodbench
