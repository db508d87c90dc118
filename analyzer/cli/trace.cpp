// `ncvet trace`: the motions of a program, one JSON object a line.
#include "analyzer/cli/trace.h"

#include "analyzer/setup/session.h"
#include "analyzer/trace/trace.h"
#include "formats/text/json_text.h"
#include "formats/text/plain_text.h"

#include "llvm/Support/raw_ostream.h"
#include <nlohmann/json.hpp>

#include <cmath>

namespace ncvet::cli {

namespace {

using Json = nlohmann::ordered_json; // keys in the order of insertion

/// Coordinates are told to a millionth of a millimetre or degree: what is after it is rounding.
Json numberOf(const Interval &value) {
  constexpr double steps = 1e6;
  if (!value.isConstant() || !std::isfinite(value.value()))
    return nullptr;
  return std::round(value.value() * steps) / steps + 0.0;
}

llvm::StringRef nameOf(Axis axis) {
  static constexpr llvm::StringLiteral names[] = {"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
  return names[size_t(axis)];
}

llvm::StringRef nameOf(MoveKind kind) {
  static constexpr llvm::StringLiteral names[] = {"rapid", "linear", "arc",     "thread",
                                                  "dwell", "tool",   "spindle", "end"};
  return names[size_t(kind)];
}

std::string planeOf(const std::array<Axis, 2> &axes) {
  return (nameOf(axes[0]) + nameOf(axes[1])).str();
}

Json feedModeOf(Action mode) {
  return mode == Action::FeedPerMinute       ? Json("per-minute")
         : mode == Action::FeedPerRevolution ? Json("per-revolution")
         : mode == Action::FeedInverseTime   ? Json("inverse-time")
                                             : Json(nullptr);
}

Json spindleOf(uint8_t state) {
  return state == spindleOff        ? Json("off")
         : state == spindleCw       ? Json("cw")
         : state == spindleCcw      ? Json("ccw")
         : state == spindleOriented ? Json("oriented")
                                    : Json(nullptr);
}

class TraceWriter : public TraceSink {
public:
  explicit TraceWriter(llvm::raw_ostream &out, const Dialect &dialect) : out_(out) {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
      if (axis != Axis::Y || !dialect.isLathe())
        axes_ |= 1u << unsigned(axis);
  }

  void moved(const TracedMove &traced) override {
    const Move &move = traced.move;
    Json line = head(*traced.unit, traced.begin, nameOf(move.kind));
    switch (move.kind) {
    case MoveKind::Arc:
      writeTo(line, move);
      line["center"] = Json::object();
      for (size_t i = 0; i < 2; ++i)
        line["center"][nameOf(move.plane[i]).str()] = numberOf(move.centre[i]);
      line["turns"] = numberOf(move.turns);
      line["direction"] = move.clockwise ? "cw" : "ccw";
      line["plane"] = planeOf(move.plane);
      writeFeed(line, move);
      break;
    case MoveKind::Linear:
    case MoveKind::Thread:
      writeTo(line, move);
      writeFeed(line, move);
      break;
    case MoveKind::Rapid:
      writeTo(line, move);
      break;
    case MoveKind::Dwell:
      line["seconds"] = numberOf(move.value);
      break;
    case MoveKind::Tool:
      line["tool"] = numberOf(move.value);
      break;
    case MoveKind::Spindle:
      line["spindle"] = spindleOf(move.spindle);
      line["speed"] = numberOf(move.value);
      break;
    case MoveKind::End:
      writeTo(line, move);
      break;
    }
    put(line);
  }

  void lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) override {
    Json line = head(unit, where.begin, "unknown");
    line["why"] = why.str();
    put(line);
    lost_ = true;
  }

  bool hasLost() const { return lost_; }

private:
  static Json head(const FileUnit &unit, uint32_t begin, llvm::StringRef kind) {
    Json line = Json::object();
    line["path"] = unit.source.display();
    line["line"] = unit.source.lines().lineOf(begin);
    line["kind"] = kind.str();
    return line;
  }

  /// Main axes always, others from when they have a coordinate on.
  void writeTo(Json &line, const Move &move) {
    Json to = Json::object(), machine = Json::object();
    for (unsigned i = 0; i < axisCount; ++i) {
      const bool onMachine = move.machineAxes >> i & 1;
      if (!move.to[i].isUnknown())
        axes_ |= 1u << i;
      if (!(axes_ >> i & 1))
        continue;
      to[nameOf(Axis(i)).str()] = onMachine ? Json(nullptr) : numberOf(move.to[i]);
      if (onMachine && move.to[i].isConstant())
        machine[nameOf(Axis(i)).str()] = numberOf(move.to[i]);
    }
    line["to"] = std::move(to);
    if (!machine.empty())
      line["machine"] = std::move(machine);
  }

  static void writeFeed(Json &line, const Move &move) {
    line["feed"] = numberOf(move.feed);
    line["feedMode"] = feedModeOf(move.feedMode);
  }

  void put(const Json &line) { out_ << jsonText(line) << '\n'; }

  llvm::raw_ostream &out_;
  uint32_t axes_ = 0; ///< bit per axis that is written
  bool lost_ = false;
};

} // namespace

TraceCommand::TraceCommand() : Command("trace", "write the motions that a program makes") {
  setup_.declare(options);
  options.section("Input");
  options.add("--stdin-filename", &stdinFilename_, "what standard input (-) is called")
      .valued("NAME");
  options.operands("FILE", file_, 1, 1);
}

llvm::Expected<const SourceFile *> TraceCommand::open(SourceSet &sources) const {
  const std::string &name = file_.front();
  if (name != "-") {
    auto file = sources.open(name, name);
    if (!file)
      return file.takeError();
    if (const std::string wrong = whyNoProgram((*file)->text()); !wrong.empty())
      return failure(name + ": " + wrong);
    return *file;
  }
  auto text = readStandardInput();
  if (!text)
    return text.takeError();
  return &sources.add(stdinFilename_.empty() ? "<stdin>" : stdinFilename_, (*text)->getBuffer(),
                      stdinFilename_);
}

int TraceCommand::run() {
  if (!stdinFilename_.empty() && file_.front() != "-")
    return fail("--stdin-filename needs - as FILE");
  SessionOptions given;
  if (llvm::Error wrong = setup_.apply(given))
    return fail(std::move(wrong));
  Session session(std::move(given));
  SourceSet sources;
  auto source = open(sources);
  if (!source)
    return fail(source.takeError());
  const SourceFile &file = **source;
  auto setup = session.setup(file.path().empty() ? file.display() : file.path(), file.text());
  if (!setup)
    return fail(setup.takeError());
  Project project(sources, setup->dialect, *setup->machine, setup->config->searchFolders,
                  setup->folders);
  TraceWriter writer(llvm::outs(), *setup->dialect);
  trace(project, project.unit(file), setup->limits, writer);
  return writer.hasLost() ? exitFindings : exitClean;
}

} // namespace ncvet::cli
