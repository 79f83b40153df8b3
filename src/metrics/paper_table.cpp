#include "metrics/paper_table.h"

#include <algorithm>

#include "metrics/json_view.h"

namespace hlodbench {

extern const char* const kPaperTable1Json;  // generated at build time

namespace {

std::optional<double> readOptional(const JsonView& view, std::string_view key) {
  const std::optional<JsonView> value = view.find(key);
  return value ? std::optional(value->number()) : std::nullopt;
}

PaperPsnr readPsnr(const JsonView& view) {
  return {view.at("mean").number(), view.at("stddev").number()};
}

PaperRow readRow(const JsonView& view) {
  return {view.at("strategy").text(),   view.at("label").text(), view.at("dn").number(),
          readOptional(view, "rarn"),   readOptional(view, "d"), view.at("fps").number(),
          readOptional(view, "speedup")};
}

PaperScene readScene(const JsonView& view) {
  PaperScene scene;
  scene.id = view.at("id").text();
  scene.label = view.at("label").text();
  scene.triangles = view.at("triangles").number();
  scene.nodes = view.at("nodes").number();
  scene.delayedShare = view.at("delayed_share").number();
  const JsonView rows = view.at("rows");
  for (std::size_t i = 0; i < rows.size(); ++i) scene.rows.push_back(readRow(rows.item(i)));
  const JsonView psnr = view.at("psnr_db");
  scene.y = readPsnr(psnr.at("y"));
  scene.cb = readPsnr(psnr.at("cb"));
  scene.cr = readPsnr(psnr.at("cr"));
  return scene;
}

PaperTable readPaperTable() {
  const std::string name = "paper_table1.json";
  const nlohmann::json json = parseJson(kPaperTable1Json, name);
  const JsonView view(json, name);
  PaperTable table;
  table.title = view.at("title").text();
  table.citation = view.at("citation").text();
  const JsonView scenes = view.at("scenes");
  for (std::size_t i = 0; i < scenes.size(); ++i) table.scenes.push_back(readScene(scenes.item(i)));
  return table;
}

}  // namespace

const PaperRow* PaperScene::find(const std::string& strategy) const {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const PaperRow& row) { return row.strategy == strategy; });
  return found == rows.end() ? nullptr : &*found;
}

const PaperScene* PaperTable::find(const std::string& sceneId) const {
  const auto found = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const PaperScene& scene) { return scene.id == sceneId; });
  return found == scenes.end() ? nullptr : &*found;
}

const PaperTable& paperTable1() {
  static const PaperTable table = readPaperTable();
  return table;
}

}  // namespace hlodbench
