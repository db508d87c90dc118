// The reference of the tables: a section for each record and each vocabulary, as Markdown.
#include "formats/schema/reference_writer.h"

#include "formats/dialect/stored_names.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/Twine.h"
#include "llvm/Support/raw_ostream.h"

#include <cmath>
#include <vector>

namespace ncvet {

namespace {

/// Vocabularies of more names than this have a section of their own.
constexpr size_t fewNames = 10;
constexpr size_t lineWidth = 100;

class ReferenceWriter {
public:
  std::string write(llvm::ArrayRef<const Record *> roots) {
    out_
        << "# Reference of the tables\n\n"
           "Every key of a dialect and of a machine profile. This page is made of the tables of "
           "keys in the\nsource by `./dev schema`, as are the JSON schemas; `README.md` beside it "
           "is the introduction.\nA key without a default is unset, empty or false when it is left "
           "out.\n";
    size_t written = 0;
    for (const Record *root : roots)
      for (records_.push_back(root); written < records_.size(); ++written)
        writeRecord(*records_[written]); // which may name further ones
    out_ << "\n# Vocabularies\n";
    for (const Shape *shape : vocabularies_)
      writeVocabulary(*shape);
    writeStoredNames();
    return std::move(out_.str());
  }

private:
  void writeRecord(const Record &record) {
    out_ << "\n## " << record.name << "\n\n" << capital(record.meaning) << ".";
    if (record.base)
      out_ << " It may have the keys of a " << linkTo(*record.base) << " too.";
    out_ << "\n\n| key | type | default | meaning | example |\n|---|---|---|---|---|\n";
    for (const Field &field : record.fields) {
      const std::string fallback =
          field.fallback && record.defaults ? field.fallback(field.shape, record.defaults()) : "";
      out_ << "| `" << field.key << "` | " << cell(typeOf(field.shape)) << " | " << code(fallback)
           << " | " << cell(field.meaning.str()) << (field.required ? " (must be there)" : "")
           << " | " << code(field.example.str()) << " |\n";
    }
  }

  void writeVocabulary(const Shape &shape) {
    out_ << "\n## " << shape.what << "\n\n";
    std::string line;
    for (llvm::StringRef name : shape.names().drop_front(shape.firstName)) {
      if (line.size() + name.size() + 3 > lineWidth) {
        out_ << line << "\n";
        line.clear();
      }
      line += (llvm::Twine(line.empty() ? "`" : " `") + name + "`").str();
    }
    out_ << line << "\n";
  }

  void writeStoredNames() {
    out_ << "\n## stored names\n\nVariables that codes leave by `stores` and that have a meaning "
            "beyond "
            "their table.\n\n| name | meaning |\n|---|---|\n";
    for (const StoredNameInfo &info : storedNames())
      out_ << "| `" << info.name << "` | " << info.meaning << " |\n";
  }

  std::string typeOf(const Shape &shape) {
    const std::string type = plainTypeOf(shape);
    return shape.otherwise ? (type + llvm::Twine(" or ") + typeOf(*shape.otherwise)).str() : type;
  }

  std::string plainTypeOf(const Shape &shape) {
    switch (shape.form) {
    case Form::Text:
      return "text";
    case Form::Flag:
      return "true or false";
    case Form::Number:
      return ("number" + llvm::Twine(boundsOf(shape))).str();
    case Form::Whole:
      return ("whole number" + llvm::Twine(boundsOf(shape))).str();
    case Form::Name:
      return namesOf(shape);
    case Form::Texts:
      return "text or list of texts";
    case Form::Addresses:
      return "set of addresses";
    case Form::Formula:
      return "formula";
    case Form::Scalar:
      return "true, false, number or text";
    case Form::List:
      return ("list of " + llvm::Twine(typeOf(*shape.of))).str();
    case Form::Map:
      return mapType(shape);
    case Form::Object:
      return linkTo(*shape.record);
    }
    return {};
  }

  std::string mapType(const Shape &shape) {
    if (!shape.of || (shape.of->form == Form::Map && !shape.of->of))
      return "object";
    const std::string key = shape.names ? namesOf(shape) : "name";
    return ("by " + llvm::Twine(key) + ": " + llvm::Twine(typeOf(*shape.of))).str();
  }

  static std::string boundsOf(const Shape &shape) {
    std::string bounds;
    llvm::raw_string_ostream text(bounds);
    if (std::isfinite(shape.least) && std::isfinite(shape.most))
      text << " " << int64_t(shape.least) << " to " << int64_t(shape.most);
    else if (std::isfinite(shape.least))
      text << " from " << int64_t(shape.least);
    return text.str();
  }

  /// The names themselves when they are few, else a link to their section.
  std::string namesOf(const Shape &shape) {
    const Names names = shape.names().drop_front(shape.firstName);
    if (names.size() > fewNames) {
      const auto same = [&](const Shape *known) { return known->names == shape.names; };
      if (llvm::none_of(vocabularies_, same))
        vocabularies_.push_back(&shape);
      return link(shape.what);
    }
    std::vector<std::string> texts;
    for (llvm::StringRef name : names)
      texts.push_back(("`" + name + "`").str());
    return llvm::join(texts, ", ");
  }

  std::string linkTo(const Record &record) {
    if (!llvm::is_contained(records_, &record))
      records_.push_back(&record);
    return link(record.name);
  }

  /// A link to the section of this name.
  static std::string link(llvm::StringRef name) {
    std::string anchor = name.lower();
    std::replace(anchor.begin(), anchor.end(), ' ', '-');
    return ("[" + name + "](#" + anchor + ")").str();
  }

  static std::string code(const std::string &text) {
    return text.empty() ? std::string() : cell(("`" + llvm::Twine(text) + "`").str());
  }
  /// Text in a cell of a table, where a stroke would end it.
  static std::string cell(const std::string &text) {
    std::string escaped;
    for (char c : text) {
      if (c == '|')
        escaped += '\\';
      escaped += c;
    }
    return escaped;
  }
  static std::string capital(llvm::StringRef text) {
    std::string copy = text.str();
    copy[0] = llvm::toUpper(copy[0]);
    return copy;
  }

  std::string text_;
  llvm::raw_string_ostream out_{text_};
  std::vector<const Record *> records_;
  std::vector<const Shape *> vocabularies_;
};

} // namespace

std::string referenceText(llvm::ArrayRef<const Record *> roots) {
  return ReferenceWriter().write(roots);
}

} // namespace ncvet
