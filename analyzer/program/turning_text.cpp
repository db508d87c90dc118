// Whether a program that states no plane is one for a lathe.
#include "analyzer/program/turning_text.h"

#include "analyzer/program/block_reading.h"
#include "formats/dialect/measure.h"
#include "formats/readers/table_words.h"

namespace ncvet {

namespace {

/// What says whose machine it is comes earlier.
constexpr unsigned mostBlocks = 2000;

bool choosesDiameters(const Dialect &dialect) {
  return llvm::any_of(dialect.codes,
                      [](const CodeInfo &code) { return code.action == Action::DiameterOn; });
}

/// What the blocks so far have.
struct Marks {
  bool x = false, z = false, turning = false;
  bool diameters = false, changes = false;

  /// A turret changes by T alone, on most lathes.
  bool ofLathe() const { return x && z && turning && (diameters || !changes); }

  /// False: the program is for a mill, or says its plane.
  bool see(const Block &block, const Dialect &dialect) {
    if (block.has(letterAddress('Y')) || block.has(letterAddress('J')))
      return false;
    x |= block.has(letterAddress('X'));
    z |= block.has(letterAddress('Z'));
    bool arc = false;
    for (const Word &word : block.words) {
      const CodeIndex index = codeOf(dialect, word);
      if (index == noCode)
        continue;
      const CodeInfo &code = dialect.codes[index];
      switch (code.action) {
      case Action::PlaneXY:
      case Action::PlaneZX:
      case Action::PlaneYZ:
        return false;
      case Action::ToolChange:
        changes = true;
        break;
      case Action::DiameterOn:
      case Action::DiameterAbsolute:
      case Action::DiameterOff:
        diameters = turning = true;
        break;
      case Action::SurfaceSpeed:
        turning = true;
        break;
      default:
        arc |= isArc(code.action);
        turning |= has(code, CycleTrait::TurnsContour);
      }
    }
    turning |= arc && block.has(letterAddress('K'));
    return true;
  }
};

} // namespace

bool readsAsTurning(const FileUnit &unit, const ProgramInfo &program) {
  const Dialect &dialect = *unit.dialect;
  if (dialect.isLathe() || dialect.group(StandardGroup::Plane) == noGroup ||
      !choosesDiameters(dialect))
    return false;
  Marks marks;
  for (const Block &block : blocks(*unit.reader, program.body, program.end, mostBlocks))
    if (!marks.see(block, dialect))
      return false;
  return marks.ofLathe();
}

} // namespace ncvet
