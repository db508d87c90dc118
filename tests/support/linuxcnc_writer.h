// Writes blocks of LinuxCNC programs: numbers in many spellings, words, places, modes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace ncvet::test {

/// The text of one program, and the modes that its blocks have left.
class LinuxCncWriter {
protected:
  explicit LinuxCncWriter(uint32_t seed) : random_(seed * 2654435761u + 17) {}

  struct Modes {
    int plane = 17;
    bool inch = false, incremental = false, diameter = false, polar = false;
    int feed = 94;
  };
  using Words = std::vector<std::string>;
  using Point = std::array<double, 3>;

  int number(int least, int most) { return least + int(random_() % uint32_t(most - least + 1)); }
  bool chance(int percent) { return number(1, 100) <= percent; }
  double real(double least, double most, double step = 0.01) {
    return least + step * number(0, int((most - least) / step));
  }
  template <typename T>
  T pick(std::vector<T> list) {
    return list[size_t(number(0, int(list.size()) - 1))];
  }

  static std::string plain(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.6f", value);
    std::string text = buffer;
    while (text.back() == '0')
      text.pop_back();
    if (text.back() == '.')
      text.pop_back();
    return text == "-0" ? "0" : text;
  }
  std::string literal(double value) {
    std::string text = plain(value);
    if (chance(10) && text.find('.') == std::string::npos)
      text += ".";
    if (chance(8) && text[0] != '-')
      text = "+" + text;
    if (chance(8) && text.rfind("0.", 0) == 0)
      text = text.substr(1);
    return text;
  }
  /// A value as a number, a parameter or an expression.
  std::string value(double v) {
    if (chance(62))
      return literal(v);
    const double part = real(-20, 20, 0.5);
    switch (number(0, 9)) {
    case 0:
      return "[" + plain(part) + " + " + plain(v - part) + "]";
    case 1:
      return "[" + plain(v * 4) + " / 4]";
    case 2:
      return "[" + plain(v + 9) + " - [3 * 3]]";
    case 3:
      return v < 0 ? "[0 - ABS[" + plain(v) + "]]" : "ABS[" + plain(-v) + "]";
    case 4:
      return "[" + plain(v) + " * [COS[60] + SIN[30]]]";
    case 5:
      return "[" + plain(v) + " * [ATAN[2]/[2] / 45]]";
    case 6:
      return v > 0 ? "SQRT[" + plain(v) + " * " + plain(v) + "]" : "[" + plain(v) + " * 2 ** 0]";
    case 7:
      return std::floor(v) == v ? pick<std::string>({"FIX[", "FUP[", "ROUND["}) + plain(v) + "]"
                                : "[" + plain(v) + " * [3 GT 2]]";
    case 8:
      return known(v);
    default:
      return assigned(v);
    }
  }
  /// A parameter that an earlier block has set, and what is missing.
  std::string known(double v) {
    if (known_.empty())
      return assigned(v);
    const auto &[name, has] = pick(known_);
    return "[" + name + " + " + plain(v - has) + "]";
  }
  /// A parameter that a line of its own sets before the block.
  std::string assigned(double v) {
    static const char *const names[] = {"depth", "Step Over", "x1", "_width", "r_out", "count"};
    const int i = ++parameters_;
    const std::string name = chance(50) ? "#<" + std::string(names[i % 6]) + std::to_string(i) + ">"
                                        : "#" + std::to_string(101 + i % 800);
    before_.push_back(name + (chance(50) ? " = " : "=") +
                      (chance(30) ? "[" + plain(v) + " + 0]" : plain(v)));
    if (certain_ && name[1] == '<')
      known_.push_back({name, v});
    return name;
  }

  std::string styled(const std::string &text) const {
    std::string result = text;
    if (lower_)
      std::transform(result.begin(), result.end(), result.begin(),
                     [](unsigned char c) { return char(std::tolower(c)); });
    return result;
  }
  void line(const std::string &text) {
    for (const std::string &one : std::exchange(before_, {}))
      text_ += styled(one) + "\n";
    if (chance(6))
      text_ += pick<std::string>({"(next)\n", "; next\n", "\n", "(MSG, on we go)\n"});
    if (chance(8))
      text_ += (lower_ ? "n" : "N") + std::to_string(lines_ += 10) + " ";
    text_ += styled(text);
    text_ += pick<std::string>({"", "", "", "", "", "", " (part)", " ; part"}) + "\n";
  }
  void block(Words words) {
    if (chance(25))
      std::shuffle(words.begin(), words.end(), random_);
    std::string text;
    for (const std::string &word : words)
      text += (text.empty() ? "" : gap_) + word;
    line(text);
  }
  void raw(const std::string &text) { text_ += styled(text) + "\n"; }

  std::string axis(size_t i, double to) {
    double v = modes_.incremental ? to - at_[i] : to;
    if (i == 0 && modes_.diameter)
      v *= 2;
    return "XYZ"[i] + value(v);
  }
  /// A rapid move to a place of known coordinates.
  void place(const Point &to) {
    Words words = {"G0"};
    if (modes_.incremental)
      words.insert(words.begin(), "G90");
    modes_.incremental = false;
    at_ = to;
    for (size_t i = 0; i < 3; ++i)
      words.push_back(axis(i, to[i]));
    block(words);
  }
  Point somewhere() { return {real(-40, 40), real(-40, 40), real(2, 30)}; }
  void distance() {
    if (!chance(35))
      return;
    modes_.incremental = !modes_.incremental;
    line(modes_.incremental ? "G91" : "G90");
  }
  std::string feedWord() { return "F" + value(real(50, 900, 10)); }
  /// The words that a cut needs by the feed mode.
  void withFeed(Words &words) {
    if (modes_.feed == 93)
      words.push_back("F" + plain(real(1, 20, 0.5)));
    else if (chance(12))
      words.push_back(feedWord());
  }
  void allModes() {
    modes_ = {modes_.plane, modes_.inch, chance(20), false, false, 94};
    modes_.diameter = lathe_ && chance(60);
    block({"G" + std::to_string(modes_.plane), modes_.inch ? "G20" : "G21",
           modes_.incremental ? "G91" : "G90", modes_.diameter ? "G7" : "G8", "G94", feedWord()});
  }
  void plane() {
    if (lathe_ || !chance(45))
      return;
    modes_.plane = pick<int>({17, 18, 19});
    line("G" + std::to_string(modes_.plane));
  }
  /// Both axes of the plane and its normal.
  std::array<size_t, 3> order() const {
    return modes_.plane == 17   ? std::array<size_t, 3>{0, 1, 2}
           : modes_.plane == 18 ? std::array<size_t, 3>{2, 0, 1}
                                : std::array<size_t, 3>{1, 2, 0};
  }

  void head() {
    if (chance(25))
      raw("%");
    modes_.plane = lathe_ ? 18 : 17;
    modes_.inch = chance(20);
    allModes();
    block({"T" + std::to_string(number(1, 30)), "M6"});
    block({"S" + value(number(2, 40) * 100), pick<std::string>({"M3", "M3", "M4"})});
    place(somewhere());
  }

  std::mt19937 random_;
  std::string text_, gap_;
  bool lower_ = false, lathe_ = false;
  bool certain_ = true; ///< what is written now runs in any case, in the main program
  int parameters_ = 0, lines_ = 0;
  Modes modes_;
  Point at_{};
  Words before_; ///< assignments that the next line needs
  std::vector<std::pair<std::string, double>> known_;
};

} // namespace ncvet::test
