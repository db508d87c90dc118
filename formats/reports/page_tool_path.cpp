// The path of a tool in a page: see docs/trace-format.md.
#include "formats/reports/page_json.h"
#include "formats/reports/page_parts.h"
#include "formats/reports/tool_path_json.h"
#include "formats/text/json_text.h"

#include <nlohmann/json.hpp>

namespace ncvet {

using Json = nlohmann::ordered_json; // keys in the order of insertion

namespace {

template <typename Number>
Json numberOr(const std::optional<Number> &value) {
  return value ? Json(*value) : Json(nullptr);
}

Json numberOr(int value) { return value < 0 ? Json(nullptr) : Json(value); }

/// One array of each list: `get` gives the number of an element.
template <typename T, typename List, typename Get>
std::string column(const List &list, Get get) {
  NumberBytes bytes;
  for (const auto &element : list)
    bytes.add(T(get(element)));
  return bytes.base64();
}

/// The moves from `first` up to `last`, numbered from zero.
Json curveJson(const PathCurve &curve, size_t first, size_t last) {
  const llvm::ArrayRef<PathMove> moves = llvm::makeArrayRef(curve.moves).slice(first, last - first);
  Json json = Json::object();
  json["count"] = moves.size();
  json["kind"] = column<uint8_t>(
      moves, [](const PathMove &move) { return uint8_t(move.motion) | (move.machine ? 0x80 : 0); });
  for (size_t i = 0; i < 3; ++i)
    json[std::string(1, "xyz"[i])] =
        column<float>(moves, [i](const PathMove &move) { return move.to[i]; });
  json["line"] = column<uint32_t>(moves, [](const PathMove &move) { return move.line; });
  NumberBytes at, file;
  uint32_t number = 0;
  const PathMove *before = nullptr;
  for (const PathMove &move : moves) {
    if (!before || before->file != move.file) {
      at.add(number);
      file.add(move.file);
    }
    before = &move;
    ++number;
  }
  json["files"] = {{"move", at.base64()}, {"file", file.base64()}};
  const auto from = [&](size_t move) {
    return llvm::partition_point(curve.arcs, [&](const PathArc &arc) { return arc.move < move; });
  };
  const llvm::ArrayRef<PathArc> all(curve.arcs);
  const auto begin = size_t(from(first) - curve.arcs.begin());
  const llvm::ArrayRef<PathArc> some =
      all.slice(begin, size_t(from(last) - curve.arcs.begin()) - begin);
  Json arcs = Json::object();
  arcs["move"] = column<uint32_t>(some, [&](const PathArc &arc) { return arc.move - first; });
  arcs["axes"] =
      column<uint8_t>(some, [](const PathArc &arc) { return arc.first | arc.second << 4; });
  arcs["first"] = column<float>(some, [](const PathArc &arc) { return arc.centre[0]; });
  arcs["second"] = column<float>(some, [](const PathArc &arc) { return arc.centre[1]; });
  arcs["turns"] = column<float>(some, [](const PathArc &arc) { return arc.turns; });
  json["arcs"] = std::move(arcs);
  return json;
}

Json curveJson(const PathCurve &curve) { return curveJson(curve, 0, curve.moves.size()); }

Json changesJson(llvm::ArrayRef<PathChange> changes) {
  Json json = Json::object();
  json["move"] = column<uint32_t>(changes, [](const PathChange &change) { return change.move; });
  json["value"] = column<float>(changes, [](const PathChange &change) { return change.value; });
  json["kind"] = column<uint8_t>(changes, [](const PathChange &change) { return change.kind; });
  return json;
}

llvm::StringRef nameOf(PathSpindle spindle) {
  static constexpr llvm::StringLiteral names[] = {"unknown", "off", "cw", "ccw", "oriented"};
  return names[size_t(spindle)];
}

Json settingJson(const PathSetting &setting) {
  return {{"tool", numberOr(setting.tool)},
          {"lengthOffset", numberOr(setting.lengthOffset)},
          {"radiusOffset", numberOr(setting.radiusOffset)},
          {"workOffset", setting.workOffset},
          {"cycle", setting.cycle},
          {"side", setting.side > 0   ? "left"
                   : setting.side < 0 ? "right"
                                      : ""},
          {"spindle", nameOf(setting.spindle).str()},
          {"speed", numberOr(setting.speed)},
          {"surfaceSpeed", setting.surfaceSpeed},
          {"speedLimit", numberOr(setting.speedLimit)}};
}

Json sectionsJson(llvm::ArrayRef<PathSection> sections) {
  Json json = Json::object();
  json["move"] = column<uint32_t>(sections, [](const PathSection &at) { return at.move; });
  json["setting"] = column<uint32_t>(sections, [](const PathSection &at) { return at.setting; });
  json["operation"] =
      column<uint32_t>(sections, [](const PathSection &at) { return at.operation; });
  return json;
}

Json boxJson(const PathBox &box) {
  Json least = Json::array(), greatest = Json::array();
  for (size_t i = 0; i < 3; ++i) {
    least.push_back(numberOr(box.min[i]));
    greatest.push_back(numberOr(box.max[i]));
  }
  return {{"min", std::move(least)}, {"max", std::move(greatest)}};
}

Json machineJson(const PathMachine &machine) {
  Json json = Json::object();
  json["envelope"] = boxJson(machine.envelope);
  json["rapid"] = numberOr(machine.rapid);
  json["feedMax"] = numberOr(machine.feedMax);
  json["spindleMax"] = numberOr(machine.spindleMax);
  json["acceleration"] = numberOr(machine.acceleration);
  json["toolChange"] = numberOr(machine.toolChange);
  json["stock"] = machine.stock ? boxJson(*machine.stock) : Json(nullptr);
  json["clamps"] = Json::array();
  for (const PathBox &clamp : machine.clamps)
    json["clamps"].push_back(boxJson(clamp));
  json["offsets"] = Json::object();
  for (const auto &[code, place] : machine.offsets) {
    Json origin = Json::array();
    for (const std::optional<double> &coordinate : place)
      origin.push_back(numberOr(coordinate));
    json["offsets"][code] = std::move(origin);
  }
  json["tools"] = Json::object();
  for (const auto &[number, tool] : machine.tools)
    json["tools"][std::to_string(number)] = {
        {"kind", tool.kind}, {"radius", numberOr(tool.radius)}, {"length", numberOr(tool.length)}};
  return json;
}

Json endJson(const PathEnd &end) {
  static constexpr llvm::StringLiteral kinds[] = {"whole", "unknown", "cut"};
  return {
      {"kind", kinds[end.kind].str()}, {"file", end.file}, {"line", end.line}, {"why", end.why}};
}

Json operationJson(const PathOperation &operation) {
  return {{"comment", operation.comment},
          {"cycle", operation.cycle},
          {"tool", numberOr(operation.tool)},
          {"file", operation.file},
          {"line", operation.line}};
}

Json namesJson(llvm::ArrayRef<std::string> names) {
  Json list = Json::array();
  for (const std::string &name : names)
    list.push_back(name);
  return list;
}

template <typename List, typename Write>
Json listJson(const List &list, Write write) {
  Json json = Json::array();
  for (const auto &element : list)
    json.push_back(write(element));
  return json;
}

/// A change of a list, with its new elements as `write` gives them.
template <typename T, typename Write>
Json changeJson(const std::vector<T> &list, const ListChange &change, Write write) {
  return {{"first", change.first},
          {"removed", change.removed},
          {"added", write(llvm::makeArrayRef(list).slice(change.first, change.added))}};
}

/// Moves that only end elsewhere.
Json placesJson(const PathCurve &curve, llvm::ArrayRef<uint32_t> moved) {
  Json json = Json::object();
  json["move"] = column<uint32_t>(moved, [](uint32_t move) { return move; });
  for (size_t i = 0; i < 3; ++i)
    json[std::string(1, "xyz"[i])] =
        column<float>(moved, [&](uint32_t move) { return curve.moves[move].to[i]; });
  return json;
}

Json changeJson(const PathCurve &curve, const ListChange &change) {
  return {{"first", change.first},
          {"removed", change.removed},
          {"added", curveJson(curve, change.first, change.first + change.added)}};
}

} // namespace

std::string toolPathText(const ToolPath &path, llvm::ArrayRef<std::string> files) {
  Json json = Json::object();
  json["version"] = 1;
  json["files"] = namesJson(files);
  json["machineKind"] = path.lathe ? "lathe" : "mill";
  json["diameter"] = path.diameter;
  json["programmed"] = curveJson(path.programmed);
  json["centre"] = path.centre.moves.empty() ? Json(nullptr) : curveJson(path.centre);
  json["feeds"] = changesJson(path.feeds);
  json["dwells"] = changesJson(path.dwells);
  json["others"] = changesJson(path.others);
  json["sections"] = sectionsJson(path.sections);
  json["settings"] = listJson(path.settings, settingJson);
  json["operations"] = listJson(path.operations, operationJson);
  json["end"] = endJson(path.end);
  json["machine"] = machineJson(path.machine);
  return jsonText(json);
}

std::string toolPathChangeText(const ToolPath &path, llvm::ArrayRef<std::string> files,
                               const ToolPathChange &change, bool byPlaces) {
  Json json = Json::object();
  json["version"] = 1;
  json["files"] = namesJson(files);
  json["lines"] = {{"from", change.line}, {"by", change.lines}};
  if (byPlaces && !change.moved.empty())
    json["programmed"] = {{"first", change.moves.first},
                          {"removed", change.moves.removed},
                          {"places", placesJson(path.programmed, change.moved)}};
  else
    json["programmed"] = changeJson(path.programmed, change.moves);
  json["centre"] = path.centre.moves.empty() && change.centre.isEmpty()
                       ? Json(nullptr)
                       : changeJson(path.centre, change.centre);
  json["feeds"] = changeJson(path.feeds, change.feeds, changesJson);
  json["dwells"] = changeJson(path.dwells, change.dwells, changesJson);
  json["others"] = changeJson(path.others, change.others, changesJson);
  json["sections"] = changeJson(path.sections, change.sections, sectionsJson);
  json["settings"] =
      listJson(llvm::makeArrayRef(path.settings).drop_front(change.settings), settingJson);
  json["operations"] = changeJson(path.operations, change.operations, [](auto operations) {
    return listJson(operations, operationJson);
  });
  json["end"] = endJson(path.end);
  return jsonText(json);
}

void writeToolPathJson(const Report &report, const ToolPath &path, llvm::raw_ostream &out) {
  std::vector<std::string> files;
  for (const FileId file : path.files)
    files.push_back(report.sources->get(file).display());
  writeJsonInPage(toolPathText(path, files), out);
}

} // namespace ncvet
