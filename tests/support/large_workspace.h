// The programs of a workspace that has more of them than anybody opens.
#pragma once

#include <functional>
#include <string>

namespace ncvet::test {

/// Half of them are main programs, each of which calls one of the others.
class LargeWorkspace {
public:
  explicit LargeWorkspace(unsigned programs) : programs_(programs) {}

  static std::string nameOf(unsigned number) {
    const std::string digits = std::to_string(number);
    return "O" + std::string(4 - digits.size(), '0') + digits;
  }

  /// A row of holes for each of three tools; the last cycle is left on where the program ends.
  std::string mainProgram(unsigned number) const {
    std::string text =
        "%\n" + nameOf(number) + " (PLATE, FANUC 0I-MF)\nN10 G17 G21 G40 G80 G90 G94\n";
    for (unsigned tool = 1; tool <= 3; ++tool) {
      const std::string t = std::to_string(tool);
      text += "T" + t + " M06\nG54 G00 X0. Y0. S1200 M03\nG43 H" + t +
              " Z50. M08\nG81 X10. Y10. Z-10. R2. F200.\n";
      for (unsigned hole = 0; hole < 30; ++hole)
        text += "X" + std::to_string(hole * 7 % 90) + ". Y" + std::to_string(number % 90) + ".\n";
      text += "G80\nM98 P" + std::to_string(number + programs_ / 2) +
              "\nG00 Z50. M09\nG91 G28 Z0.\nG90\n";
    }
    return text + "G81 X10. Y10. Z-10. R2. F200.\nM30\n%\n";
  }

  /// Gives the name and the text of each file.
  void write(const std::function<void(const std::string &, const std::string &)> &file) const {
    for (unsigned number = 1; number <= programs_ / 2; ++number) {
      file(nameOf(number) + ".nc", mainProgram(number));
      file(nameOf(number + programs_ / 2) + ".nc", subprogram(number + programs_ / 2));
    }
  }

private:
  static std::string subprogram(unsigned number) {
    std::string text = "%\n" + nameOf(number) + " (SUB)\n";
    for (unsigned i = 0; i < 50; ++i)
      text +=
          "G01 X" + std::to_string(i * 11 % 90) + ". Y" + std::to_string(i * 5 % 70) + ". F300.\n";
    return text + "G00 Z50.\nM99\n%\n";
  }

  unsigned programs_;
};

} // namespace ncvet::test
