// Arcs of blocks of which it is known what they do: their geometry is that of the last one, with
// other numbers.
#include "analyzer/rule/known_arcs.h"

#include "interp/evaluate/block_words.h"

namespace ncvet {

namespace {

int indexOf(const Block &block, const Word *word) {
  return word ? int(word - block.words.begin()) : -1;
}

const Word *wordAt(const Block &block, int index) {
  return index < 0 ? nullptr : &block.words[size_t(index)];
}

bool isSame(const ArcGeometry &a, const ArcGeometry &b) {
  return a.start == b.start && a.end == b.end && a.centreWords == b.centreWords &&
         a.centreAbsolute == b.centreAbsolute && a.radius == b.radius;
}

} // namespace

void KnownArcs::Entry::fill(const Block &block, ArcWords &words) const {
  words = words_;
  for (size_t i = 0; i < 2; ++i)
    words.centre[i] = wordAt(block, centre_[i].word);
  words.foreign = wordAt(block, foreign_);
  words.radius = wordAt(block, radius_.word);
  words.angle = wordAt(block, angle_);
}

/// In machine coordinates and under a transformation the blocks are of another kind.
void KnownArcs::Entry::place(const MachineState &state, std::optional<Point> &at) const {
  const Interval &x = state.at(words_.axes[0]), &y = state.at(words_.axes[1]);
  if (x.isConstant() && y.isConstant())
    at.emplace(x.value() / lengths_[0], y.value() / lengths_[1]);
}

void KnownArcs::Entry::fill(const Block &block, const MachineState &before,
                            const MachineState &after, ArcGeometry &arc) const {
  place(before, arc.start);
  place(after, arc.end);
  if (radius_.word >= 0)
    arc.radius = radius_.in(block);
  if (hasCentre_) {
    Point &words = arc.centreWords.emplace(Point::Zero());
    for (size_t i = 0; i < 2; ++i)
      if (centre_[i].word >= 0)
        words[Eigen::Index(i)] = centre_[i].in(block);
  }
  arc.centreAbsolute = centreAbsolute_;
}

KnownArcs::Entry &KnownArcs::keep(uint64_t known, const Block &block, const ArcWords &words) {
  Entry &entry = entries_[known % entries_.size()];
  entry = {};
  entry.known = known;
  entry.words_ = words;
  for (size_t i = 0; i < 2; ++i)
    entry.centre_[i].word = indexOf(block, words.centre[i]);
  entry.radius_.word = indexOf(block, words.radius);
  entry.foreign_ = indexOf(block, words.foreign);
  entry.angle_ = indexOf(block, words.angle);
  return entry;
}

void KnownArcs::keepGeometry(Entry &entry, const Block &block, const Dialect &dialect,
                             const MachineProfile &machine, const MachineState &before,
                             const MachineState &after, const ArcGeometry &arc) {
  const ArcWords &words = entry.words_;
  // Where X may be a diameter more than the modes may decide where it is.
  const bool mayBeDiameter =
      dialect.group(StandardGroup::Diameter) != noGroup && words.axes[0] == Axis::Z;
  if (!words.planeKnown || mayBeDiameter || !arc.start || !arc.end)
    return;
  for (Entry::Length *length : {&entry.centre_[0], &entry.centre_[1], &entry.radius_})
    if (const Word *word = wordAt(block, length->word)) {
      const auto factor = lengthFactor(*word, dialect, machine, after);
      if (!factor || !word->isNumber())
        return;
      length->factor = *factor;
    }
  for (size_t i = 0; i < 2; ++i)
    entry.lengths_[i] = dialect.lengthsPerUnit(words.axes[i]);
  entry.hasCentre_ = arc.centreWords.has_value();
  entry.centreAbsolute_ = arc.centreAbsolute;
  ArcGeometry again;
  entry.fill(block, before, after, again);
  entry.hasGeometry = isSame(again, arc);
}

} // namespace ncvet
