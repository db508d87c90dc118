// Parts of LinuxCNC programs, one for each feature of the language.
#pragma once

#include "tests/support/linuxcnc_writer.h"

namespace ncvet::test {

/// Each part begins at a place of its own, in the modes that are in force.
class LinuxCncSections : protected LinuxCncWriter {
protected:
  using LinuxCncWriter::LinuxCncWriter;

  void lines() {
    distance();
    bool rapid = chance(50);
    bool said = false;
    for (int i = number(2, 6); i > 0; --i) {
      Words words;
      if (!said || chance(40)) {
        rapid = chance(40);
        words.push_back(rapid ? pick<std::string>({"G0", "G00"})
                              : pick<std::string>({"G1", "G01"}));
        said = true;
      }
      if (!rapid)
        withFeed(words);
      const int axes = number(1, 7);
      for (size_t j = 0; j < 3; ++j)
        if (axes >> j & 1) {
          const double v = modes_.incremental ? real(-8, 8) : real(-40, 40);
          words.push_back("XYZ"[j] + value(v));
        }
      if (chance(12))
        words.push_back(pick<std::string>({"A", "B", "C"}) + value(real(-90, 90, 5)));
      if (chance(6) && !modes_.incremental) {
        words.push_back("G53");
        if (words[0][0] != 'G' || words[0] == "G53")
          words.push_back(rapid ? "G0" : "G1");
      }
      block(words);
    }
  }

  void arcs() {
    plane();
    place(somewhere());
    distance();
    const bool absolute = chance(20);
    if (absolute)
      line("G90.1");
    for (int i = number(1, 4); i > 0; --i)
      arc(absolute);
    if (absolute)
      line("G91.1");
  }
  void arc(bool absolute) {
    const auto [first, second, normal] = order();
    const double radius = real(2, 12), from = real(0, 350, 10), sweep = real(20, 340, 10);
    const bool clockwise = chance(50), full = chance(15);
    constexpr double degree = 3.14159265358979323846 / 180;
    const double to = from + (full ? 0 : clockwise ? -sweep : sweep);
    const double centre[] = {at_[first] - radius * std::cos(from * degree),
                             at_[second] - radius * std::sin(from * degree)};
    Point end = at_;
    end[first] = centre[0] + radius * std::cos(to * degree);
    end[second] = centre[1] + radius * std::sin(to * degree);
    if (chance(30))
      end[normal] += real(-3, 3);
    Words words = {clockwise ? "G2" : "G3"};
    withFeed(words);
    if (!full || chance(50))
      for (const size_t i : {first, second})
        words.push_back(axis(i, end[i]));
    if (end[normal] != at_[normal])
      words.push_back(axis(normal, end[normal]));
    if (!full && chance(35)) {
      words.push_back("R" + value(sweep > 180 ? -radius : radius));
    } else {
      const size_t axes[] = {first, second};
      for (size_t i = 0; i < 2; ++i) {
        const double offset = centre[i] - (absolute ? 0 : at_[axes[i]]);
        if (absolute || plain(offset) != "0")
          words.push_back("IJK"[axes[i]] + value(offset));
      }
      if (chance(25))
        words.push_back("P" + std::to_string(number(1, 3)));
    }
    block(words);
    at_ = end;
    resync();
  }
  /// Now and then the place is said anew, so that rounding does not add up.
  void resync() {
    for (double &v : at_)
      v = std::round(v * 1e6) / 1e6;
  }

  void cycles() {
    plane();
    Point start = somewhere();
    const size_t normal = order()[2];
    start[normal] = real(5, 30);
    place(start);
    if (chance(60))
      line(pick<std::string>({"G98", "G99"}));
    if (chance(40)) {
      modes_.incremental = true;
      line("G91");
    }
    if (modes_.feed != 94) {
      modes_.feed = 94;
      block({"G94", feedWord()});
    }
    const std::string code =
        pick<std::string>({"G81", "G81", "G82", "G83", "G73", "G85", "G86", "G89"});
    Words words = {code};
    const double back = real(1, 12), depth = real(-15, 0.5);
    words.push_back("XYZ"[normal] + value(modes_.incremental ? depth - 1 : depth));
    words.push_back("R" + value(modes_.incremental ? back - 6 : back));
    if (code == "G82" || code == "G86" || code == "G89")
      words.push_back("P" + value(real(0, 2, 0.1)));
    if (code == "G83" || code == "G73")
      words.push_back("Q" + value(real(0.5, 4, 0.25)));
    for (int i = number(1, 4); i > 0; --i) {
      hole(words, normal);
      words.clear();
    }
    line("G80");
  }
  void hole(Words words, size_t normal) {
    const bool polar = modes_.plane == 17 && chance(12);
    if (polar) {
      words.push_back("@" + value(real(3, 20)));
      words.push_back("^" + value(real(0, 360, 5)));
    }
    for (size_t i = 0; i < 3 && !polar; ++i)
      if (i != normal && (chance(70) || words.size() < 2))
        words.push_back("XYZ"[i] + value(modes_.incremental ? real(-9, 9) : real(-40, 40)));
    if (chance(25))
      words.push_back("L" + std::to_string(number(1, 4)));
    if (chance(8))
      words.push_back(pick<std::string>({"G98", "G99"}));
    if (words.size() > 0)
      block(words);
  }

  void polar() {
    if (modes_.plane != 17) {
      modes_.plane = 17;
      line("G17");
    }
    place({real(3, 30), real(3, 30), real(1, 9)});
    const bool incremental = chance(40);
    modes_.incremental = incremental;
    line(incremental ? "G91" : "G90");
    for (int i = number(2, 5); i > 0; --i) {
      Words words = {pick<std::string>({"G0", "G1"})};
      if (words[0] == "G1")
        withFeed(words);
      const int which = number(1, 3);
      if (which & 1)
        words.push_back("@" + value(incremental ? real(0.5, 4) : real(2, 30)));
      if (which & 2)
        words.push_back("^" + value(incremental ? real(-60, 60, 5) : real(-180, 180, 5)));
      if (chance(30))
        words.push_back("Z" + value(real(-3, 9)));
      block(words);
    }
    if (lathe_) {
      modes_.plane = 18;
      line("G18");
    }
  }

  void offsets() {
    const int system = number(1, 9);
    static const char *const codes[] = {"G54", "G55",   "G56",   "G57",  "G58",
                                        "G59", "G59.1", "G59.2", "G59.3"};
    const bool here = chance(40);
    Words words = {"G10", here ? "L20" : "L2", "P" + std::to_string(chance(30) ? 0 : system)};
    for (size_t i = 0; i < 3; ++i)
      if (chance(60))
        words.push_back("XYZ"[i] + value(real(-25, 25)));
    if (!here && chance(25) && !lathe_)
      words.push_back("R" + value(real(-90, 90, 15)));
    block(words);
    lines();
    if (chance(70))
      line(codes[chance(50) ? system - 1 : number(0, 8)]);
    lines();
    if (chance(50))
      place(somewhere());
  }
  void presets() {
    Words words = {"G92"};
    for (size_t i = 0; i < 3; ++i)
      if (chance(60) || (i == 2 && words.size() == 1))
        words.push_back("XYZ"[i] + value(real(-25, 25)));
    block(words);
    lines();
    for (const std::string &code : pick<Words>({{"G92.1"}, {"G92.2", "G92.3"}, {"G92.2"}, {}})) {
      line(code);
      lines();
    }
  }

  void compensation() {
    if (modes_.plane == 19) {
      modes_.plane = 17;
      line("G17");
    }
    const auto [first, second, normal] = order();
    const double scale = modes_.inch ? 1 / 25.4 : 1;
    const double x = real(-20, 20), y = real(-20, 20);
    Point start = somewhere();
    start[first] = x;
    start[second] = y;
    place(start);
    const bool dynamic = chance(40);
    Words words = {pick<std::string>({"G41", "G42"}) + (dynamic ? ".1" : "")};
    words.push_back("D" + (dynamic ? value(std::round(real(2, 6) * scale * 1e4) / 1e4)
                                   : std::to_string(number(1, 12))));
    block(words);
    const double side[] = {chance(50) ? 1.0 : -1.0, chance(50) ? 1.0 : -1.0};
    Point to = at_;
    to[first] += side[0] * real(8, 14) * (modes_.inch ? 0.5 : 1);
    cut(to);
    for (int i = number(2, 5); i > 0; --i) {
      to[i % 2 ? first : second] += side[i % 2] * real(4, 18) * (chance(25) ? -1 : 1);
      if (chance(30))
        to[i % 2 ? second : first] += real(2, 9);
      if (chance(15))
        block({pick<std::string>({"G0", "G1"}), axis(normal, at_[normal])});
      if (chance(30))
        corner(to);
      else
        cut(to);
    }
    line("G40");
    to[first] += real(10, 20);
    to[second] += real(10, 20);
    cut(to);
  }
  void cut(const Point &to) {
    Words words = {"G1"};
    withFeed(words);
    for (const size_t i : {order()[0], order()[1]})
      if (to[i] != at_[i] || chance(20))
        words.push_back(axis(i, to[i]));
    if (words.size() == 1)
      return;
    block(words);
    at_ = to;
    resync();
  }
  /// An arc by its radius to a place.
  void corner(const Point &to) {
    const auto [first, second, normal] = order();
    const double way = std::hypot(to[first] - at_[first], to[second] - at_[second]);
    if (way < 0.1)
      return;
    Words words = {pick<std::string>({"G2", "G3"})};
    withFeed(words);
    words.push_back(axis(first, to[first]));
    words.push_back(axis(second, to[second]));
    words.push_back("R" + value(std::round(way * real(0.6, 1.5) * 1e3) / 1e3));
    block(words);
    at_ = to;
    resync();
  }

  void toolLengths() {
    if (!lengthsAllowed_)
      return lines();
    for (int i = number(1, 3); i > 0; --i) {
      const std::string tool = std::to_string(number(1, 30));
      switch (number(0, 5)) {
      case 0: // (after a change rs274 2.9.0 is where its last move led)
        place(somewhere());
        block({"T" + tool, "M6"});
        line(chance(50) ? "G43" : "G43 H" + tool);
        break;
      case 1:
        block({"G43", "H" + tool});
        break;
      case 2:
        block({"G43.1", "Z" + value(real(-9, 30))});
        break;
      case 3:
        block({"G43.2", "H" + tool});
        break;
      case 4:
        line("G49");
        break;
      default:
        block({"G10", pick<std::string>({"L1", "L1", "L10", "L11"}), "P" + tool,
               "Z" + value(real(1, 40))});
        line("G43 H" + tool);
      }
      lines();
    }
    if (chance(60))
      line("G49");
  }

  void feedModes() {
    modes_.feed = pick<int>({93, 94, 95});
    Words words = {"G" + std::to_string(modes_.feed)};
    if (modes_.feed != 93)
      words.push_back("F" + plain(modes_.feed == 95 ? real(0.05, 0.4) : real(50, 500, 10)));
    block(words);
    chance(50) ? lines() : arcs();
    if (chance(70)) {
      modes_.feed = 94;
      block({"G94", feedWord()});
    }
  }

  void auxiliary() {
    for (int i = number(1, 4); i > 0; --i) {
      const std::string n = std::to_string(number(0, 3));
      line(pick<std::string>({"G4 P" + value(real(0, 2, 0.1)),
                              "G61",
                              "G61.1",
                              "G64",
                              "G64 P0.05",
                              "G64 P0.1 Q0.02",
                              "M7",
                              "M8",
                              "M7 M8",
                              "M9",
                              "M48",
                              "M49",
                              "M50 P1",
                              "M51 P0",
                              "M62 P" + n,
                              "M63 P" + n,
                              "M64 P" + n,
                              "M65 P" + n,
                              "M67 E" + n + " Q" + value(real(0, 9)),
                              "M68 E" + n + " Q1",
                              "M3 S" + value(number(3, 30) * 100),
                              "M5",
                              "S1200 M4",
                              "M0",
                              "M1",
                              "G97 S800",
                              "G96 D2500 S120",
                              "M19 R45",
                              "G40",
                              "G80",
                              "G49"}));
    }
    if (chance(50))
      line("S900 M3");
  }

  void stored() {
    const std::string code = pick<std::string>({"G28", "G30"});
    if (chance(70)) {
      place(somewhere());
      line(code + ".1");
      place(somewhere());
    }
    if (chance(50))
      block({code});
    else
      block({code, pick<std::string>({"X", "Y", "Z"}) + value(real(-5, 5))});
    lines();
  }

  void readsPlaces() {
    place(somewhere());
    for (int i = number(1, 3); i > 0; --i) {
      // (Stored lengths are in the unit of the machine, which is the inch for rs274.)
      const std::string source = pick<std::string>({"#5420",
                                                    "#5421",
                                                    "#5422",
                                                    "#<_x>",
                                                    "#<_y>",
                                                    "#<_z>",
                                                    "#5220",
                                                    "[#<_metric> * 4]",
                                                    "[#<_absolute> + 2]",
                                                    "[#<_incremental> + 1]",
                                                    "[#<_imperial> + 2]",
                                                    "[#<_coord_system> / 100]",
                                                    "#5400",
                                                    "[#<_feed> / 100]",
                                                    "[#<_plane> / 10]",
                                                    "[#<_ccomp> / 20]",
                                                    "[#<_current_tool> / 2]",
                                                    "[#<_rpm> / 500]",
                                                    "[#<_lathe_diameter_mode> + 1]",
                                                    "[EXISTS[#<nothing>] + 1]"});
      block({pick<std::string>({"G0", "G0", "G0"}), pick<std::string>({"X", "Y", "Z"}) + source});
    }
    place(somewhere());
  }

  /// (rs274 2.9.0 does not convert a tool length that is in force.)
  void units() {
    if (!mayChangeUnits_)
      return lines();
    line("G49");
    lengthsAllowed_ = false;
    modes_.inch = !modes_.inch;
    line(modes_.inch ? "G20" : "G21");
    line(feedWord());
    lines();
  }

  void threads() {
    if (modes_.plane != 18) {
      modes_.plane = 18;
      line("G18");
    }
    place({real(10, 20), 0, real(2, 8)});
    line("S600 M3");
    const bool straight = chance(50);
    if (straight) {
      for (int i = number(1, 3); i > 0; --i)
        block({"G33", "Z" + value(real(-20, -1)), "K" + value(real(0.5, 2, 0.25))});
      if (chance(30))
        block({"G33.1", "Z" + value(real(-9, -1)), "K1.5"});
    } else {
      modes_.incremental = chance(20);
      line(modes_.incremental ? "G91" : "G90");
      Words words = {"G76",
                     "P" + value(real(0.5, 2, 0.25)),
                     "Z" + value(real(-20, -2)),
                     "I" + value(pick<double>({-1, -0.5, 1, 2})),
                     "J" + value(real(0.1, 0.5, 0.05)),
                     "K" + value(real(0.6, 1.5, 0.1))};
      if (chance(50))
        words.push_back("R" + value(real(1, 2, 0.25)));
      if (chance(50))
        words.push_back("Q" + value(real(0, 30, 0.5)));
      if (chance(50))
        words.push_back("H" + std::to_string(number(0, 3)));
      if (chance(50)) {
        words.push_back("E" + value(real(0.2, 1, 0.1)));
        words.push_back("L" + std::to_string(number(0, 3)));
      }
      block(words);
    }
    if (!lathe_) {
      modes_.plane = 17;
      line("G17");
    }
  }

  bool lengthsAllowed_ = true, mayChangeUnits_ = true;
};

} // namespace ncvet::test
