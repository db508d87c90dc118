// Chooses a reader by the name in the dialect's table.
#include "formats/readers/select/make_reader.h"

#include "formats/readers/ecs/ecs_reader.h"
#include "formats/readers/iso/iso_reader.h"
#include "formats/readers/mefi/mefi_reader.h"
#include "formats/readers/sinumerik/sinumerik_reader.h"

namespace ncvet {

std::unique_ptr<Reader> makeReader(const Dialect &dialect, llvm::StringRef text) {
  if (dialect.reader == "ecs")
    return std::make_unique<EcsReader>(dialect, text);
  if (dialect.reader == "mefi")
    return std::make_unique<MefiReader>(dialect, text);
  if (dialect.reader == "sinumerik")
    return std::make_unique<SinumerikReader>(dialect, text);
  return std::make_unique<IsoReader>(dialect, text);
}

} // namespace ncvet
