// Packs tables and unpacks them.
#include "formats/packed/packed_tables.h"

#include "formats/packed/packer.h"
#include "formats/text/needed_text.h"

namespace ncvet {

static_assert(std::endian::native == std::endian::little, "doubles are packed as they are here");

/// It has a base, whose members are not its own.
template <typename Visit>
void visitMembers(const OtherControlFile &of, Visit visit) {
  visit(of.marks, of.extensions, of.readAs, of.forMachine, of.alike, of.highest);
}
template <typename Visit>
void visitMembers(OtherControlFile &of, Visit visit) {
  visit(of.marks, of.extensions, of.readAs, of.forMachine, of.alike, of.highest);
}

llvm::Expected<PackedIndex> loadIndex() {
  PackedIndex index;
  index.dialects = listDialects();
  auto detection = loadDetection();
  if (!detection)
    return detection.takeError();
  index.detection = std::move(*detection);
  const auto add = [&](llvm::ArrayRef<DetectMark> marks) {
    for (const DetectMark &mark : marks)
      index.needed[mark.pattern] = neededTexts(mark.pattern);
  };
  for (const DialectSummary &dialect : index.dialects)
    add(dialect.detect);
  for (const auto &[name, control] : index.detection.otherControls)
    add(control.marks);
  return index;
}

std::string pack(const Dialect &dialect) {
  Dialect packed = dialect;
  for (TableLayer &layer : packed.layers) { // the texts are in the program already
    layer.text = {};
    layer.kept = nullptr;
  }
  std::string bytes;
  Packer(bytes).all(packed);
  return bytes;
}

std::string pack(const PackedIndex &index) {
  std::string bytes;
  Packer(bytes).all(index);
  return bytes;
}

std::shared_ptr<Dialect> unpackDialect(llvm::StringRef bytes) {
  auto dialect = std::make_shared<Dialect>();
  Unpacker unpacker(bytes);
  unpacker.all(*dialect);
  assert(unpacker.atEnd() && "what was packed is as long as what is unpacked");
  dialect->variableRanges.shown = dialect->shown.get();
  for (TableLayer &layer : dialect->layers)
    for (const RulesetFile &file : builtinRulesetFiles())
      if (file.name == layer.name)
        layer.text = file.text;
  return dialect;
}

PackedIndex unpackIndex(llvm::StringRef bytes) {
  PackedIndex index;
  Unpacker(bytes).all(index);
  return index;
}

} // namespace ncvet
