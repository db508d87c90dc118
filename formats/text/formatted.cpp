// Texts with values in them, in the form of llvm::formatv.
#include "formats/text/formatted.h"

#include "llvm/ADT/SmallVector.h"
#include "llvm/Support/FormatVariadic.h"

namespace ncvet {
namespace {

/// What llvm::formatv is made of, without the types of its values.
class Form final : public llvm::formatv_object_base {
public:
  Form(llvm::StringRef form, llvm::ArrayRef<llvm::detail::format_adapter *> values)
      : formatv_object_base(form, values) {}
};

} // namespace

void TextArgument::format(llvm::raw_ostream &out, llvm::StringRef style) {
  switch (kind_) {
  case Kind::Text:
    return llvm::format_provider<llvm::StringRef>::format(text_, out, style);
  case Kind::Printed:
    out << *printed_;
    return;
  case Kind::Real:
    return llvm::format_provider<double>::format(real_, out, style);
  case Kind::Signed:
    return llvm::format_provider<int64_t>::format(whole_, out, style);
  case Kind::Unsigned:
    return llvm::format_provider<uint64_t>::format(uint64_t(whole_), out, style);
  }
}

std::string formatted(llvm::StringRef form, llvm::MutableArrayRef<TextArgument> values) {
  llvm::SmallVector<llvm::detail::format_adapter *, 8> adapters;
  for (TextArgument &value : values)
    adapters.push_back(&value);
  return Form(form, adapters).str();
}

} // namespace ncvet
