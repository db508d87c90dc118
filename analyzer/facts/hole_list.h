// The holes of a list that is being run, and the places of those that came before.
#pragma once

#include "analyzer/rule/hole_row.h"
#include "analyzer/rule/rule.h"

namespace ncvet {

struct HolePlace {
  TextPlace block, end; ///< of its block
  TextPlace list;       ///< where the list of holes begins
  unsigned depth = 0;
  uint64_t offset = 0;
  uint64_t key = 0; ///< of offset and position

  bool isOfListOf(const HolePlace &other) const {
    return depth == other.depth && list == other.list;
  }
};

/// What is the same of all holes whose blocks do the same but for their numbers.
struct KindOfHole {
  uint64_t known = 0; ///< see `Outcome::known`; 0: there is none
  StateUse use;       ///< what was looked at to find it out
  HolePlace place;    ///< but for its block and its numbers
};

/// The kinds of holes of one call of a cycle, and where the last one of them was.
struct LastRow {
  Origin call;
  Axis tool = Axis::Z;
  uint64_t offset = 0; ///< the same as in `HolePlace`
  std::array<KindOfHole, 8> kinds{};
  std::array<Interval, axisCount> position{};
  std::array<uint64_t, axisCount> parts{}; ///< what each of these adds to `key`
  uint64_t key = 0;                        ///< the same as in `HolePlace`

  const KindOfHole *find(uint64_t known) const {
    const KindOfHole &kind = kinds[known % kinds.size()];
    return known && kind.known == known ? &kind : nullptr;
  }
  /// A row of another call, in another plane, or under another work offset.
  void begin(const Origin &by, Axis along, uint64_t system) {
    call = by;
    tool = along;
    offset = system;
    for (KindOfHole &kind : kinds)
      kind.known = 0;
  }
};

/// The holes of the list that is being run. Runs that add to them tell what they add.
class HoleList {
public:
  LastRow row;

  /// The block of the first hole at its place.
  struct Made {
    uint32_t begin, end;
    uint64_t key; ///< of the place
  };

  bool continues(const HolePlace &place) const {
    return place.depth == depth_ && place.list == list_;
  }
  /// The first hole at that place of the list; null: there is none.
  const Made *find(const HolePlace &place) const {
    return slots_.empty() ? nullptr : holeAt(slotOf(place.key));
  }
  /// The hole that the same list has made there before; null: there is none.
  const Made *add(const HolePlace &place) {
    if (!continues(place))
      clear();
    depth_ = place.depth;
    list_ = place.list;
    return addToSame(place.key, place.block.offset, place.end.offset);
  }
  /// The same of the hole of a block that goes on with the row, where that continues the list.
  const Made *addNext(uint32_t begin, uint32_t end) { return addToSame(row.key, begin, end); }
  /// The same of the hole at another place.
  const Made *addNext(uint64_t key, const HoleRow::Hole &hole) {
    return addToSame(key, hole.begin, hole.end);
  }

private:
  static constexpr size_t longestList = 5000;
  /// A power of two. There are more slots for longer lists, so that the next free one is near.
  static constexpr size_t fewestSlots = 1u << 8;
  static constexpr size_t slotsOfHole = 3;
  /// A slot holds the index of a hole, from 1, and above it the number of the list to which it
  /// belongs: those of lists before it are free.
  static constexpr unsigned indexBits = 16;
  static constexpr uint32_t mostLists = (uint32_t(1) << (32 - indexBits)) - 1;

  /// The hole of that key; null: there was none, or the list is too long, and it was added.
  const Made *addToSame(uint64_t key, uint32_t begin, uint32_t end) {
    if (made_.size() > longestList)
      return nullptr;
    const size_t slot = slotOf(key);
    if (const Made *const known = holeAt(slot))
      return known;
    made_.push_back({begin, end, key});
    slots_[slot] = number_ << indexBits | uint32_t(made_.size());
    if (made_.size() * slotsOfHole > slots_.size())
      grow();
    return nullptr;
  }
  void grow() {
    slots_.assign(slots_.size() * 2, 0);
    for (size_t i = 0; i < made_.size(); ++i)
      slots_[slotOf(made_[i].key)] = number_ << indexBits | uint32_t(i + 1);
  }
  /// The hole of that slot; null: it is free.
  const Made *holeAt(size_t slot) const {
    const uint32_t index = slots_[slot] ^ number_ << indexBits;
    return index - 1 < made_.size() ? &made_[index - 1] : nullptr;
  }
  /// Where the hole of that key is, or would be.
  size_t slotOf(uint64_t key) const {
    const size_t mask = slots_.size() - 1;
    size_t slot = key & mask;
    for (const Made *made = holeAt(slot); made && made->key != key; made = holeAt(slot))
      slot = (slot + 1) & mask;
    return slot;
  }
  void clear() {
    if (slots_.empty() || number_ == mostLists) {
      slots_.assign(std::max(slots_.size(), fewestSlots), 0);
      number_ = 0;
    }
    ++number_;
    made_.clear();
  }

  std::vector<Made> made_;      ///< the first hole at each place of the list that is being run
  std::vector<uint32_t> slots_; ///< by key
  uint32_t number_ = 0;         ///< of the list, from 1
  unsigned depth_ = ~0u;        ///< of the hole that was added last
  TextPlace list_;              ///< the same
};

} // namespace ncvet
