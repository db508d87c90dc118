// Makes LinuxCNC programs out of a seed: the same ones on every machine.
#pragma once

#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace ncvet::test {

class LinuxCncGenerator {
public:
  explicit LinuxCncGenerator(uint32_t seed) : random_(seed) {}

  /// What a program may be about; each of them alone, too.
  static constexpr const char *themes[] = {
      "lines", "arcs",  "splines",     "cycles", "systems", "presets",  "lengths", "machine places",
      "units", "polar", "expressions", "flow",   "threads", "diameter", "dwells",  "compensation"};
  static constexpr size_t themeCount = std::size(themes);

  /// A program about one theme, or about several where `theme` is `themeCount`.
  std::string program(size_t theme) {
    out_.clear();
    line("G21 G90 G17 G94 G98 F200 S500 M3");
    restart();
    const unsigned parts = theme < themeCount ? 2 : 4;
    for (unsigned i = 0; i < parts; ++i) {
      part(theme < themeCount ? theme : below(themeCount - 1)); // the last one is left to itself
      settle();
    }
    line("M2");
    return subprograms_ + out_;
  }

private:
  // Numbers

  unsigned below(size_t count) { return unsigned(random_() % count); }
  bool chance(unsigned percent) { return below(100) < percent; }
  double length(double most = 40) { // in steps that both print alike
    return (double(below(size_t(most * 2000))) - most * 1000) / 1000;
  }
  double positive(double most = 10) { return 0.5 + double(below(size_t(most * 1000))) / 1000; }
  static std::string number(double value) {
    std::string text;
    llvm::raw_string_ostream(text) << llvm::format("%.6f", value);
    return text;
  }
  std::string word(const char *letter, double value) { return letter + number(value) + " "; }
  void line(const std::string &text) { out_ += text + "\n"; }

  // Places

  /// Modes as at the start.
  void settle() {
    line("G80 G90 G21 G17 G98 G91.1 G8 G94 F200");
    line("G92.1");
    line("G49");
    line("G54");
    restart();
  }
  void restart() {
    at_ = {length(), length(), 5 + positive(30)};
    line("G0 " + word("X", at_[0]) + word("Y", at_[1]) + word("Z", at_[2]));
  }
  std::string axes(bool all = false) {
    std::string text;
    const char *letters[] = {"X", "Y", "Z"};
    for (const char *letter : letters)
      if (all || chance(60))
        text += word(letter, length());
    return text.empty() ? word("X", length()) : text;
  }

  // Themes

  void part(size_t theme) {
    using Part = void (LinuxCncGenerator::*)();
    static constexpr Part parts[] = {
        &LinuxCncGenerator::lines,       &LinuxCncGenerator::arcs,
        &LinuxCncGenerator::splines,     &LinuxCncGenerator::cycles,
        &LinuxCncGenerator::systems,     &LinuxCncGenerator::presets,
        &LinuxCncGenerator::lengths,     &LinuxCncGenerator::machinePlaces,
        &LinuxCncGenerator::units,       &LinuxCncGenerator::polar,
        &LinuxCncGenerator::expressions, &LinuxCncGenerator::flow,
        &LinuxCncGenerator::threads,     &LinuxCncGenerator::diameter,
        &LinuxCncGenerator::dwells,      &LinuxCncGenerator::compensation};
    static_assert(std::size(parts) == themeCount);
    (this->*parts[theme])();
  }

  void lines() {
    for (unsigned i = 0; i < 6; ++i) {
      std::string text = chance(30) ? chance(50) ? "G90 " : "G91 " : "";
      text += i == 0 || chance(50) ? chance(40) ? "G0 " : "G1 " : "";
      text += axes();
      if (chance(20))
        text += word(chance(50) ? "A" : "B", length(90));
      if (chance(20))
        text += word("F", 10 + positive(500));
      line(text);
    }
  }

  /// Arcs by centre and by radius, in all planes, with and without a path across.
  void arcs() {
    static constexpr const char *codes[] = {"G17", "G18", "G19"};
    static constexpr std::array<size_t, 3> axesOf[] = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};
    static constexpr const char *letters[] = {"X", "Y", "Z"}, *centres[] = {"I", "J", "K"};
    for (unsigned i = 0; i < 5; ++i) {
      const size_t plane = below(3);
      const auto [first, second, across] = axesOf[plane];
      const bool relative = chance(30), absoluteCentre = chance(25), clockwise = chance(50);
      const double radius = positive(20), begin = below(360) * degree;
      const double sweep = (5 + below(350)) * degree * (clockwise ? -1 : 1);
      std::array<double, 3> centre = at_, end = at_;
      centre[first] -= radius * std::cos(begin);
      centre[second] -= radius * std::sin(begin);
      const bool byRadius = chance(40), full = !byRadius && chance(15);
      end[first] = centre[first] + radius * std::cos(begin + (full ? 0 : sweep));
      end[second] = centre[second] + radius * std::sin(begin + (full ? 0 : sweep));
      if (chance(40))
        end[across] += length(10);
      std::string text = std::string(codes[plane]) + (relative ? " G91 " : " G90 ") +
                         (absoluteCentre ? "G90.1 " : "G91.1 ") + (clockwise ? "G2 " : "G3 ");
      for (const size_t axis : {first, second, across})
        if (!full && (axis != across || end[axis] != at_[axis]))
          text += word(letters[axis], relative ? end[axis] - at_[axis] : end[axis]);
        else if (end[axis] != at_[axis])
          end[axis] = at_[axis];
      if (byRadius) {
        text += word("R", std::fabs(sweep) > std::numbers::pi ? -radius : radius);
      } else {
        for (const size_t axis : {first, second})
          text += word(centres[axis], absoluteCentre ? centre[axis] : centre[axis] - at_[axis]);
        if (chance(20))
          text += "P" + std::to_string(1 + below(3));
      }
      line(text);
      at_ = end;
    }
  }

  void splines() {
    line("G1 " + axes());
    for (unsigned i = 0; i < 3; ++i)
      switch (below(3)) {
      case 0:
        line("G5 " + word("I", length(5)) + word("J", length(5)) + word("P", length(5)) +
             word("Q", length(5)) + word("X", length()) + word("Y", length()));
        if (chance(50))
          line("G5 " + word("P", length(5)) + word("Q", length(5)) + word("X", length()) +
               word("Y", length()));
        break;
      case 1:
        line("G5.1 " + word("X", length()) + word("Y", length()) + word("I", length(5)) +
             word("J", length(5)));
        break;
      default:
        line("G5.2 " + word("X", length()) + word("Y", length()) + "P1 L3");
        for (unsigned point = 0; point < 3; ++point)
          line(word("X", length()) + word("Y", length()) + "P" + std::to_string(1 + below(2)));
        line("G5.3");
      }
    line("G1 " + word("Z", length()));
  }

  void cycles() {
    static constexpr const char *codes[] = {"G73", "G81", "G82", "G83", "G84", "G85", "G86", "G89"};
    static constexpr const char *planes[] = {"G17", "G18", "G19"};
    static constexpr const char *letters[][3] = {{"X", "Y", "Z"}, {"X", "Z", "Y"}, {"Y", "Z", "X"}};
    const size_t plane = chance(60) ? 0 : below(3);
    const auto &[first, second, depth] = letters[plane];
    line(std::string("G80 ") + planes[plane]);
    const bool relative = chance(35);
    if (relative)
      line("G91");
    std::string code;
    for (unsigned i = 0; i < 3; ++i) {
      const bool other = i == 0 || chance(60);
      do // rs274 swaps the axes of G84 in the other planes
        code = other ? codes[below(std::size(codes))] : code;
      while (plane && code == "G84");
      std::string text = chance(40) ? chance(50) ? "G98 " : "G99 " : "";
      if (other)
        text += code + " ";
      text += word(first, length(20)) + (chance(70) ? word(second, length(20)) : "");
      if (other || chance(30)) {
        text += word(depth, relative ? -positive(8) : -positive(12));
        text += word("R", relative ? -positive(3) : positive(4));
        if (code == "G73" || code == "G83")
          text += "Q" + number(positive(4)) + " ";
        if (code == "G82" || code == "G86" || code == "G89")
          text += "P" + number(positive(2)) + " ";
      }
      if (chance(30))
        text += "L" + std::to_string(1 + below(3));
      line(text);
    }
    line("G80");
  }

  void systems() {
    static constexpr const char *codes[] = {"G54", "G55",   "G56",   "G57",  "G58",
                                            "G59", "G59.1", "G59.2", "G59.3"};
    for (unsigned i = 0; i < 5; ++i) {
      const std::string number = "P" + std::to_string(below(10)) + " ";
      switch (below(4)) {
      case 0:
        line("G10 L2 " + number + axes() + (chance(40) ? word("R", length(90)) : ""));
        break;
      case 1:
        line("G10 L20 " + number + axes());
        break;
      default:
        line(codes[below(std::size(codes))]);
      }
      line((chance(50) ? "G0 " : "G1 ") + axes());
    }
    for (unsigned system = 1; system <= 9; ++system) // no angles for what comes after
      line("G10 L2 P" + std::to_string(system) + " R0");
  }

  void presets() {
    for (unsigned i = 0; i < 5; ++i) {
      switch (below(6)) {
      case 0:
      case 1:
        line("G92 " + axes());
        break;
      case 2:
        line("G52 " + axes());
        break;
      case 3:
        line("G92.1");
        break;
      case 4:
        line("G92.2");
        break;
      default:
        line("G92.3");
      }
      line("G0 " + axes());
    }
  }

  void lengths() {
    for (unsigned i = 0; i < 4; ++i) {
      const std::string tool = std::to_string(1 + below(20));
      switch (below(6)) {
      case 5:
        line("G10 L1 P" + tool + " " + word("Z", length(10)) + (chance(30) ? "R1" : ""));
        line("G43 H" + tool);
        break;
      case 0:
        line("T" + tool + " M6"); // in one block with G43 rs274 forgets to move its zero point
        line("S500 M3");
        line("G43");
        break;
      case 1:
        line("G43 H" + tool);
        break;
      case 2:
        line("G43.1 " + word("Z", length(10)));
        break;
      case 3:
        line("G43.2 H" + tool);
        break;
      default:
        line("G49");
      }
      line("G1 " + (chance(60) ? axes() : word("X", length())));
    }
  }

  void machinePlaces() {
    for (unsigned i = 0; i < 4; ++i) {
      const char *code = chance(50) ? "G28" : "G30";
      switch (below(4)) {
      case 0:
        line(std::string("G53 ") + (chance(70) ? "G0 " : "G1 ") + axes());
        break;
      case 1:
        line(std::string(code) + ".1");
        break;
      case 2:
        line(std::string(code) + " " + (chance(60) ? axes() : ""));
        break;
      default:
        line((chance(50) ? "G43 H3" : "G92 X1"));
      }
      line("G0 " + axes());
    }
  }

  void units() {
    for (unsigned i = 0; i < 4; ++i) {
      line(chance(50) ? "G20" : "G21");
      line("G1 " + axes() + word("F", 5 + positive(20)));
      line("G0 " + axes(true));
      line("G1 G91 " + axes());
      line("G90");
    }
    line("G20");
    line("G2 G91 X1 Y1 I0.5 J0.5");
    line("G90 G21");
  }

  void polar() {
    line("G0 X0 Y0");
    line("G1 @" + number(positive(20)) + " ^" + number(length(180)));
    for (unsigned i = 0; i < 5; ++i) {
      std::string text = chance(20) ? chance(50) ? "G90 " : "G91 " : "";
      if (chance(60))
        text += "@" + number(positive(20)) + " ";
      if (chance(60) || text.empty())
        text += "^" + number(length(180)) + " ";
      line(text + (chance(20) ? word("Z", length()) : ""));
    }
  }

  std::string term(unsigned depth) {
    if (depth == 0 || chance(25))
      switch (below(4)) {
      case 0:
        return "#" + std::to_string(1 + below(8));
      case 1:
        return "#<part>";
      default:
        return number(positive(9));
      }
    static constexpr const char *operators[] = {"+", "-", "*", "/", "MOD", "+", "-"};
    static constexpr const char *functions[] = {"SIN", "COS", "ABS", "FIX", "FUP", "ROUND", "TAN"};
    if (chance(25))
      return std::string(functions[below(std::size(functions))]) + "[" + term(depth - 1) + "]";
    if (chance(10))
      return "SQRT[ABS[" + term(depth - 1) + "]]";
    if (chance(10))
      return "ATAN[" + term(depth - 1) + "]/[" + number(positive(5)) + "]";
    const char *op = operators[below(std::size(operators))];
    return "[" + term(depth - 1) + " " + op + " " +
           (*op == '/' || *op == 'M' ? number(positive(5)) : term(depth - 1)) + "]";
  }
  void expressions() {
    line("#<part> = " + number(positive(9)));
    for (unsigned i = 1; i <= 8; ++i)
      line("#" + std::to_string(i) + " = " + number(positive(9)));
    for (unsigned i = 0; i < 6; ++i) {
      if (chance(50))
        line("#" + std::to_string(1 + below(8)) + " = [[" + term(2) + "] MOD 50]");
      line("G1 X[[" + term(3) + "] MOD 100] Y[[" + term(2) + "] MOD 100]");
    }
    line("#1 = 3 #2 = [#1 + 1]");
    line("G1 X#1 Y#2 #1 = 8");
    line("X#1");
    line("X[[#1 GT 2] + [#2 EQ #2] + [1 AND 0] + [0 OR 5] + [3 XOR 0]] Y[2 ** 3]");
    line("G91 X[#5420 / 10] Y[#5421 / 10]");
    line("G90");
  }

  void flow() {
    const std::string label = std::to_string(100 + 10 * below(80));
    if (subprograms_.find("o" + label + " sub") == std::string::npos)
      subprograms_ += "o" + label + " sub\n  G91 G0 X[#1 / 10] Y#2\n  o" + label +
                      "1 if [#1 GT 5]\n    Z1\n  o" + label + "1 else\n    Z-1\n  o" + label +
                      "1 endif\n  G90\no" + label + " endsub [#1 * 2]\n";
    line("o" + label + " call [" + number(positive(9)) + "] [" + number(length(5)) + "]");
    line("G0 Z#<_value>");
    const std::string own = std::to_string(2000 + below(7000) * 10);
    line("#10 = " + std::to_string(1 + below(4)));
    // rs274 leaves a DO loop after its first pass where an earlier loop was left by BREAK.
    unsigned kind = below(4);
    if (kind == 1 && broke_)
      kind = 0;
    broke_ |= kind == 3;
    switch (kind) {
    case 0:
      line("o" + own + " while [#10 GT 0]");
      line("  G1 X[#10 * 2] Y" + number(length()));
      line("  #10 = [#10 - 1]");
      line("o" + own + " endwhile");
      break;
    case 1:
      line("o" + own + " do");
      line("  G1 X[#10 * 3]");
      line("  #10 = [#10 - 1]");
      line("o" + own + " while [#10 GT 0]");
      break;
    case 2:
      line("o" + own + " repeat [#10]");
      line("  G91 G0 X1 Y0.5");
      line("  G90");
      line("o" + own + " endrepeat");
      break;
    default:
      line("o" + own + " while [1]");
      line("  #10 = [#10 + 1]");
      line("  G1 Y#10");
      line("  o" + own + "1 if [#10 GT 6]");
      line("    o" + own + " break");
      line("  o" + own + "1 endif");
      line("  G1 X#10");
      line("o" + own + " endwhile");
    }
  }

  void threads() {
    line("G33 " + word("Z", length()) + "K" + number(positive(2)));
    line("G0 X10 Z5");
    line("G33.1 Z-" + number(positive(10)) + " K" + number(positive(2)));
    line("G0 X20 Z10");
    const char *const ends[] = {"", "L1 E0.5", "L2 E0.5", "L3 E0.5"};
    line("G76 P" + number(positive(2)) + " Z-" + number(positive(20)) + " I-" +
         number(positive(2)) + " J" + number(0.1 + positive(1) / 10) + " K" +
         number(0.8 + positive(1) / 4) + (chance(50) ? " R" + number(1 + positive(1) / 4) : "") +
         (chance(40) ? " Q29.5" : "") + (chance(40) ? " H" + std::to_string(below(3)) : "") + " " +
         ends[below(4)]);
    line("G0 X30");
  }

  void diameter() {
    line("G18 G7");
    line("G0 X40 Z5");
    for (unsigned i = 0; i < 4; ++i)
      line((chance(50)   ? "G1 "
            : chance(50) ? "G91 G1 "
                         : "G90 G0 ") +
           word("X", positive(40)) + (chance(50) ? word("Z", length()) : ""));
    line("G90 G1 X20 Z0");
    line("G2 X30 Z-5 I5 K0");
    line(chance(50) ? "G8" : "G92 X10");
    line("G1 X5");
  }

  void dwells() {
    for (unsigned i = 0; i < 4; ++i) {
      line("G4 P" + number(positive(2)));
      line("G1 " + axes());
    }
  }

  /// Contours of lines and arcs with outside and inside corners, most of them with room for the
  /// tool; some in inches, some that begin with an arc, some that lead straight back.
  void compensation() {
    const unsigned tool = 1 + below(8);
    line("T" + std::to_string(tool) + " M6");
    line("S500 M3");
    const bool turned = chance(20); // in the ZX plane
    const auto [first, second, across] =
        turned ? std::array<size_t, 3>{2, 0, 1} : std::array<size_t, 3>{0, 1, 2};
    line(turned ? "G18" : "G17");
    const bool inch = chance(20);
    scale_ = inch ? 1 / 25.4 : 1;
    if (inch)
      line("G20");
    at_ = {scale_ * length(), scale_ * length(), scale_ * length()};
    line("G0 " + word("X", at_[0]) + word("Y", at_[1]) + word("Z", at_[2]));
    std::string code = chance(50) ? "G41" : "G42";
    double radius = scale_ * (1 + tool * 0.125);
    if (chance(40)) {
      const double cutter = scale_ * positive(8);
      code += ".1 D" + number(cutter);
      radius = cutter / 2;
    } else if (chance(40)) {
      const unsigned other = 1 + below(8);
      code += " D" + std::to_string(other);
      radius = scale_ * (1 + other * 0.125);
    }
    line(code);
    heading_ = below(360) * degree;
    if (chance(15))
      bow(radius, first, second, across);
    else
      straight(chance(20) ? "G0" : "G1", radius * (chance(10) ? 0.7 : 1.2 + below(4)), first,
               second, across);
    const unsigned elements = 3 + below(6);
    for (unsigned i = 0; i < elements; ++i) {
      if (chance(15))
        line("G90 " + word(letters_[across], at_[across])); // no path
      if (chance(60))
        heading_ += chance(10) ? std::numbers::pi + (double(below(1600)) - 800) / 10000
                               : (double(below(2500)) / 10 - 125) * degree;
      if (chance(35))
        bow(radius, first, second, across);
      else
        straight(chance(8) ? "G0" : "G1", radius * (chance(12) ? 0.3 : 2) + scale_ * positive(20),
                 first, second, across);
      if (chance(12)) {
        at_[across] += scale_ * length(3);
        line(std::string(chance(50) ? "G90 G1 " : "G90 G0 ") + word(letters_[across], at_[across]));
      }
      if (chance(8))
        line("G4 P0.5");
    }
    line("G40");
    line(std::string(chance(50) ? "G90 G1 " : "G90 G0 ") + axes(true));
  }
  /// A line in the present direction.
  void straight(const char *code, double way, size_t first, size_t second, size_t across) {
    std::array<double, 3> end = at_;
    end[first] += way * std::cos(heading_);
    end[second] += way * std::sin(heading_);
    if (chance(10))
      end[across] += scale_ * length(3);
    go(code, end, end[across] != at_[across], {first, second, across});
    line("");
  }
  /// An arc that begins in the present direction.
  void bow(double cutter, size_t first, size_t second, size_t across) {
    static constexpr const char *centres[] = {"I", "J", "K"};
    const bool clockwise = chance(50);
    const double radius = chance(15) ? scale_ * positive(4) : cutter * 1.5 + scale_ * positive(15);
    const double sweep = (20 + below(chance(20) ? 320 : 130)) * degree;
    const double side = clockwise ? -1 : 1;
    const double toCentre = heading_ + side * std::numbers::pi / 2;
    const std::array<double, 2> centre{at_[first] + radius * std::cos(toCentre),
                                       at_[second] + radius * std::sin(toCentre)};
    heading_ += side * sweep;
    const double fromCentre = heading_ - side * std::numbers::pi / 2;
    std::array<double, 3> end = at_;
    end[first] = centre[0] + radius * std::cos(fromCentre);
    end[second] = centre[1] + radius * std::sin(fromCentre);
    if (chance(15))
      end[across] += scale_ * length(3);
    const std::array<double, 3> start = at_;
    go(clockwise ? "G2" : "G3", end, end[across] != at_[across], {first, second, across});
    if (chance(30) && sweep < 3)
      line(word("R", radius));
    else
      line(word(centres[first], centre[0] - start[first]) +
           word(centres[second], centre[1] - start[second]));
  }
  /// A block to `end`, without its end of line.
  void go(const std::string &code, const std::array<double, 3> &end, bool aside,
          const std::array<size_t, 3> &order) {
    const bool relative = chance(15);
    out_ += std::string(relative ? "G91 " : "G90 ") + code + " ";
    for (const size_t axis : order)
      if (axis != order[2] || aside)
        out_ += word(letters_[axis], relative ? end[axis] - at_[axis] : end[axis]);
    if (!relative && chance(5))
      out_ += word("A", length(90));
    at_ = end;
  }

  static constexpr double degree = std::numbers::pi / 180;

  std::mt19937 random_;
  std::string out_, subprograms_;
  bool broke_ = false; ///< a BREAK was written
  std::array<double, 3> at_{};
  double heading_ = 0; ///< radians from the plane's first axis
  double scale_ = 1;   ///< units of the program for a millimetre
  static constexpr const char *letters_[] = {"X", "Y", "Z"};
};

} // namespace ncvet::test
