// Makes programs of LinuxCNC in which many features of the language meet, from a seed.
#pragma once

#include "tests/support/linuxcnc_mistakes.h"
#include "tests/support/linuxcnc_sections.h"

namespace ncvet::test {

/// One program for each seed. It follows its own modes, so that most blocks are right where they
/// are; with a mistake it is rejected in one of them.
class LinuxCncMixture : private LinuxCncSections {
public:
  explicit LinuxCncMixture(uint32_t seed) : LinuxCncSections(seed) {}

  /// The text; `wrong` says whether it has one of the known mistakes.
  std::string program(bool wrong) {
    lower_ = chance(40);
    gap_ = pick<std::string>({" ", " ", "", "\t", "  "});
    lathe_ = chance(15);
    head();
    const int sections = number(2, 7);
    const int mistakeAt = wrong ? number(0, sections - 1) : -1;
    for (int i = 0; i < sections; ++i) {
      if (i == mistakeAt)
        mistake();
      section(0);
    }
    line(pick<std::string>({"M2", "M30", "G80 M5 M2", "M9 M30"}));
    return text_;
  }

private:
  struct Sub {
    std::string name;
    int arguments;
    Modes after;
    bool inch; ///< when it begins
  };

  void section(int depth) {
    const int kind = number(0, depth < 2 ? 21 : 15);
    switch (kind) {
    case 0:
    case 1:
      return lines();
    case 2:
    case 3:
      return arcs();
    case 4:
    case 5:
      return lathe_ ? threads() : cycles();
    case 6:
      return polar();
    case 7:
      return offsets();
    case 8:
      return presets();
    case 9:
      return compensation();
    case 10:
      return toolLengths();
    case 11:
      return feedModes();
    case 12:
      return auxiliary();
    case 13:
      return stored();
    case 14:
      return readsPlaces();
    case 15:
      return lathe_ || chance(40) ? threads() : units();
    case 16:
    case 17:
      return branches(depth);
    case 18:
      return loops(depth);
    case 19:
    case 20:
      return calls(depth);
    default:
      return keptModes(depth);
    }
  }

  std::string label() {
    const int i = ++labels_;
    return chance(60) ? "O" + std::to_string(100 + i) : "O<part" + std::to_string(i) + ">";
  }
  /// A body that is left out, or that runs with modes of its own; what it knows stays there.
  void body(int depth, bool runs) {
    const bool certain = std::exchange(certain_, false);
    const Modes modes = modes_;
    const Point at = at_;
    allModes();
    section(depth + 1);
    certain_ = certain;
    if (!runs) {
      modes_ = modes;
      at_ = at;
    }
  }
  void branches(int depth) {
    const std::string o = label(), p = "#" + std::to_string(40 + number(0, 20));
    const int v = number(0, 3);
    raw(p + " = " + std::to_string(v));
    const bool withElseIf = chance(50), withElse = chance(60);
    const bool first = chance(50);
    const std::string compare = pick<std::string>({" EQ ", " EQ ", " ge "});
    const bool holds = compare == " ge " ? v >= 2 : v == 2;
    raw(o + " IF [" + p + compare + "2" + (first ? " OR [1 GT 2]" : "") + "]");
    body(depth, holds);
    bool done = holds;
    if (withElseIf) {
      raw(o + " ELSEIF [" + p + " LT 1]");
      body(depth, !done && v < 1);
      done |= v < 1;
    }
    if (withElse) {
      raw(o + " ELSE");
      body(depth, !done);
    }
    raw(o + " ENDIF");
  }
  void loops(int depth) {
    const std::string o = label(), p = "#" + std::to_string(62 + depth);
    switch (number(0, 2)) {
    case 0:
      raw(o + " REPEAT [" + pick<std::string>({"2", "3", "1", "1 + 1"}) + "]");
      body(depth, true);
      raw(o + " ENDREPEAT");
      break;
    case 1:
      raw(p + " = 0");
      raw(o + " WHILE [" + p + " LT " + std::to_string(number(1, 3)) + "]");
      raw(p + " = [" + p + " + 1]");
      body(depth, true);
      // (rs274 2.9.0 leaves a DO loop that holds such a BREAK after one pass.)
      if (depth == 0 && chance(30)) {
        const std::string inner = label();
        raw(inner + " IF [" + p + " GE 2]");
        raw(o + pick<std::string>({" BREAK", " CONTINUE"}));
        raw(inner + " ENDIF");
      }
      raw(o + " ENDWHILE");
      break;
    default:
      raw(p + " = 3");
      raw(o + " DO");
      body(depth, true);
      raw(p + " = [" + p + " - 1]");
      raw(o + " WHILE [" + p + " GT 1]");
    }
  }
  void calls(int depth) {
    if (depth == 0 && (subs_.empty() || chance(50)))
      define();
    if (subs_.empty())
      return lines();
    const Sub sub = pick(subs_);
    if (sub.inch != modes_.inch)
      line("G49");
    for (int i = number(1, 2); i > 0; --i) {
      std::string text = sub.name + " CALL";
      for (int a = number(chance(20) ? 0 : sub.arguments, sub.arguments); a > 0; --a)
        text += " [" + plain(real(1, 9)) + (chance(30) ? " * 2" : "") + "]";
      raw(text);
      modes_ = sub.after;
    }
    if (chance(40))
      block({"G90", "G0", "X[#<_value> + 1]"});
    modes_.incremental = false;
    line("G90");
    place(somewhere());
  }
  void define() {
    Sub sub{label(), number(0, 3), {}, modes_.inch};
    const Modes outside = modes_;
    const bool certain = std::exchange(certain_, false);
    auto known = std::exchange(known_, {}); // names of the main program are its own
    raw(sub.name + " SUB");
    allModes();
    for (int i = 1; i <= sub.arguments; ++i)
      block({"G1", pick<std::string>({"X", "Y", "Z"}) +
                       pick<std::string>({"[#", "[2 * #", "[1 + #"}) + std::to_string(i) + "]"});
    const bool restores = chance(25);
    if (restores)
      line("M73");
    const Modes kept = modes_;
    const bool mayChange = std::exchange(mayChangeUnits_, false);
    section(2);
    mayChangeUnits_ = mayChange;
    if (chance(25)) {
      const std::string inner = label();
      raw(inner + " IF [#1 GT 4]");
      raw(sub.name + " RETURN [#1 + 1]");
      raw(inner + " ENDIF");
    }
    allModes();
    sub.after = restores ? kept : modes_;
    raw(sub.name + " ENDSUB" + pick<std::string>({"", " [3]", " [#1 * 2]"}));
    modes_ = outside;
    certain_ = certain;
    known_ = std::move(known);
    subs_.push_back(sub);
  }

  void keptModes(int depth) {
    line("M70");
    const Modes kept = modes_;
    const bool mayChange = std::exchange(mayChangeUnits_, false);
    allModes();
    section(depth + 1);
    mayChangeUnits_ = mayChange;
    line("M72");
    modes_ = kept;
    if (chance(30))
      line("M71");
    lines();
  }

  void mistake() {
    const size_t count = std::size(linuxCncMistakes);
    std::string text = linuxCncMistakes[size_t(number(0, int(count) - 1))];
    for (size_t at = 0; (at = text.find(" | ", at)) != std::string::npos; ++at)
      text.replace(at, 3, "\n");
    raw(text);
  }

  int labels_ = 0;
  std::vector<Sub> subs_;
};

} // namespace ncvet::test
