// Arcs of blocks of which it is known what they do: their geometry is that of the last one, with
// other numbers.
#pragma once

#include "interp/path/arc_block.h"

namespace ncvet {

/// Keeps by `Outcome::known` what the words of an arc mean in its modes. Belongs to one run.
class KnownArcs {
public:
  struct Entry {
    uint64_t known = 0; ///< `Outcome::known`; 0: none
    bool hasGeometry = false;
    StateUse wordsUse, geometryUse; ///< what was looked at to find it out

    void fill(const Block &block, ArcWords &words) const;
    /// As `arcGeometry`, into one of which nothing is known; only with `hasGeometry`.
    void fill(const Block &block, const MachineState &before, const MachineState &after,
              ArcGeometry &arc) const;

  private:
    friend class KnownArcs;
    /// A word that gives a length.
    struct Length {
      int word = -1;     ///< index in `Block::words`; -1: there is none
      double factor = 1; ///< millimetres per unit of its number
      double in(const Block &block) const { return block.words[size_t(word)].value() * factor; }
    };
    void place(const MachineState &state, std::optional<Point> &at) const;

    ArcWords words_; ///< of which the pointers say nothing
    std::array<Length, 2> centre_;
    Length radius_;
    int foreign_ = -1, angle_ = -1;
    std::array<double, 2> lengths_{1, 1}; ///< see `Dialect::lengthsPerUnit`
    bool hasCentre_ = false, centreAbsolute_ = false;
  };

  /// Null: nothing is kept of such blocks.
  Entry *find(uint64_t known) {
    Entry &entry = entries_[known % entries_.size()];
    return known && entry.known == known ? &entry : nullptr;
  }
  /// Keeps what `words` are in such blocks, which nothing but plain words are in.
  Entry &keep(uint64_t known, const Block &block, const ArcWords &words);
  /// Keeps what `arc` is made of, where it is the words' numbers and the two ends alone.
  static void keepGeometry(Entry &entry, const Block &block, const Dialect &dialect,
                           const MachineProfile &machine, const MachineState &before,
                           const MachineState &after, const ArcGeometry &arc);

private:
  std::array<Entry, 64> entries_;
};

} // namespace ncvet
