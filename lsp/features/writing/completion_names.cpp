// Completion of names: blocks, variables, programs, statements.
#include "lsp/features/writing/completion_sources.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSet.h"
#include "llvm/Support/Path.h"

#include <map>

namespace ncvet::lsp {

namespace {

enum NameRank : uint8_t { rankName = 1, rankStatement = 4, rankOther = 5 };

constexpr size_t mostTargets = 200;        ///< nearest to the cursor
constexpr size_t mostLooked = 100000;      ///< numbered blocks that are looked through for them
constexpr uint32_t bytesLooked = 1u << 19; ///< on each side of the cursor, for variables
constexpr size_t mostVariables = 500, mostPrograms = 500;
constexpr size_t mostDetail = 60; ///< bytes of a block that an item shows

std::string blockText(const CompletionRequest &request, uint32_t offset) {
  const SourceFile &source = request.snapshot.source();
  const uint32_t end = std::min(source.lines().lineEnd(offset), uint32_t(offset + mostDetail));
  return source.displayText(source.text().slice(offset, end).trim());
}

void addTarget(const CompletionRequest &request, std::string label, uint32_t block) {
  CompletionItem item;
  item.kind = CompletionKind::Label;
  item.rank = rankName;
  item.label = std::move(label);
  item.detail = blockText(request, block);
  request.add(std::move(item));
}

/// Numbers of the blocks nearest to the cursor that begin with what is typed.
void numberedBlocks(const CompletionRequest &request, const ProgramInfo &program,
                    const std::string &mark) {
  const llvm::ArrayRef<NumberedBlock> all = request.snapshot.unit().index.numbersAsWritten(program);
  size_t above = size_t(std::lower_bound(all.begin(), all.end(), request.context.offset,
                                         [](const NumberedBlock &block, uint32_t offset) {
                                           return block.offset < offset;
                                         }) -
                        all.begin());
  size_t below = above, found = 0;
  const auto take = [&](const NumberedBlock &block) {
    const std::string label = mark + std::to_string(block.number);
    if (!llvm::StringRef(label).startswith_insensitive(request.typed))
      return;
    ++found;
    addTarget(request, label, block.offset);
  };
  for (size_t looked = 0; looked < mostLooked && found < mostTargets; ++looked) {
    if (below == 0 && above == all.size())
      break;
    if (below > 0)
      take(all[--below]);
    if (above < all.size())
      take(all[above++]);
  }
}

bool isNameByte(char c) { return llvm::isAlnum(c) || c == '_'; }

/// The variables that the text near the cursor writes as `#1`, `#<name>`, `R1`, `V1`.
std::map<std::string, unsigned> writtenVariables(const CompletionRequest &request) {
  const llvm::StringRef all = request.snapshot.text();
  const uint32_t at = request.context.offset;
  const llvm::StringRef text = all.slice(at > bytesLooked ? at - bytesLooked : 0,
                                         std::min<size_t>(all.size(), size_t(at) + bytesLooked));
  const bool marked = request.dialect().reader == "iso";
  std::map<std::string, unsigned> found;
  const char *const cursor = all.data() + at;
  for (size_t i = 0; found.size() < mostVariables; ++i) {
    i = text.find_first_of(marked ? "#" : "RrVv", i);
    if (i == llvm::StringRef::npos)
      break;
    size_t end = i + 1;
    if (!marked && i > 0 && (isNameByte(text[i - 1]) || text[i - 1] == '$'))
      continue;
    if (marked && end < text.size() && text[end] == '<') {
      end = text.find_first_of(">\r\n", end);
      if (end == llvm::StringRef::npos || text[end] != '>')
        continue;
      ++end;
    } else {
      while (end < text.size() && llvm::isDigit(text[end]))
        ++end;
    }
    const llvm::StringRef name = text.slice(i, end);
    if (name.size() < 2 || name.end() == cursor ||
        (end < text.size() && isNameByte(text[end]) && !marked))
      continue;
    ++found[request.snapshot.source().displayText(name)];
    i = end - 1;
  }
  return found;
}

void addVariable(const CompletionRequest &request, std::string name, std::string detail) {
  CompletionItem item;
  item.kind = CompletionKind::Variable;
  item.rank = rankName;
  item.label = std::move(name);
  item.detail = std::move(detail);
  request.add(std::move(item));
}

llvm::StringRef nameOf(VariableType type) {
  switch (type) {
  case VariableType::Integer:
    return "INT";
  case VariableType::Real:
    return "REAL";
  case VariableType::Boolean:
    return "BOOL";
  case VariableType::Character:
    return "CHAR";
  case VariableType::String:
    return "STRING";
  case VariableType::Axis:
    return "AXIS";
  case VariableType::Frame:
    return "FRAME";
  case VariableType::None:
    break;
  }
  return "";
}

struct Statement {
  llvm::StringLiteral label, insert, detail;
};

constexpr Statement macroStatements[] = {
    {"IF", "IF[${1:condition}]GOTO${2:block}", "jump under a condition"},
    {"WHILE", "WHILE[${1:condition}]DO${2:1}\n$0\nEND${2:1}", "loop while a condition holds"},
    {"GOTO", "GOTO${1:block}", "jump"},
};
constexpr Statement wordStatements[] = {
    {"o if", "o${1:100} if [${2:condition}]\n$0\no${1:100} endif", "blocks under a condition"},
    {"o while", "o${1:100} while [${2:condition}]\n$0\no${1:100} endwhile",
     "loop while a condition holds"},
    {"o repeat", "o${1:100} repeat [${2:times}]\n$0\no${1:100} endrepeat",
     "loop a number of times"},
    {"o sub", "o<${1:name}> sub\n$0\no<${1:name}> endsub", "subprogram"},
    {"o call", "o<${1:name}> call", "call of a subprogram"},
};
constexpr Statement highLevelStatements[] = {
    {"IF", "IF ${1:condition}\n$0\nENDIF", "blocks under a condition"},
    {"FOR", "FOR ${1:R1}=${2:1} TO ${3:10}\n$0\nENDFOR", "loop that counts"},
    {"WHILE", "WHILE ${1:condition}\n$0\nENDWHILE", "loop while a condition holds"},
    {"LOOP", "LOOP\n$0\nENDLOOP", "endless loop"},
    {"REPEAT", "REPEAT\n$0\nUNTIL ${1:condition}", "loop until a condition holds"},
    {"DEF", "DEF ${1:REAL} ${2:NAME}", "variable"},
    {"PROC", "PROC ${1:NAME}(${2:REAL A})", "parameters of the program"},
    {"CASE", "CASE ${1:value} OF ${2:1} GOTOF ${3:LABEL} DEFAULT GOTOF ${4:LABEL}",
     "jump by a value"},
};
constexpr Statement jumpStatements[] = {
    {"GOTOF", "GOTOF ${1:LABEL}", "jump forward"},
    {"GOTOB", "GOTOB ${1:LABEL}", "jump backward"},
    {"GOTO", "GOTO ${1:LABEL}", "jump"},
};
constexpr Statement angleStatements[] = {
    {"<JMP:>", "<JMP:${1:N10}>", "jump"},
    {"<IFF<>:>", "<IFF<${1:value}>:${2:N10};${3:N20};${4:N30}>", "jump by sign"},
    {"<RPT:>", "<RPT:${1:N10};${2:N20};${3:2}>", "blocks again"},
    {"<INP:>", "<INP:\"${1:text}\";${2:R1};${3:N10}>", "input of the operator"},
};

void addStatements(const CompletionRequest &request, llvm::ArrayRef<Statement> statements) {
  for (const Statement &statement : statements) {
    CompletionItem item;
    item.kind = CompletionKind::Keyword;
    item.rank = rankStatement;
    item.label = statement.label.str();
    item.insert = statement.insert.str();
    item.snippet = true;
    item.detail = statement.detail.str();
    request.add(std::move(item));
  }
}

} // namespace

void completeTargets(const CompletionRequest &request) {
  const FileIndex &index = request.snapshot.unit().index;
  const ProgramInfo &program = index.programAt(request.context.offset);
  const bool named = request.dialect().lexical.commaSeparates; // targets are written as `N10`
  std::vector<std::pair<uint32_t, std::string>> labels;
  for (const auto &entry : index.labels(program))
    if (!entry.second.empty())
      labels.emplace_back(entry.second.front(),
                          request.snapshot.source().displayText(entry.first()));
  llvm::sort(labels);
  for (const auto &[offset, label] : labels)
    addTarget(request, label, offset);
  numberedBlocks(request, program, named ? "N" : "");
}

void completeVariables(const CompletionRequest &request) {
  const FileIndex &index = request.snapshot.unit().index;
  const ProgramInfo &program = index.programAt(request.context.offset);
  std::map<std::string, std::string> defined;
  for (const auto &entry : index.definitions(program))
    if (entry.second.kind == ItemKind::Definition || entry.second.kind == ItemKind::Parameters)
      defined[request.snapshot.source().displayText(entry.first())] =
          nameOf(entry.second.type).str();
  for (const auto &[name, type] : defined)
    addVariable(request, name, type);
  for (const auto &[name, count] : writtenVariables(request))
    addVariable(request, name, "variable of this program");
  for (const std::string &name : request.dialect().variableNames)
    addVariable(request, name, "variable of the control");
}

void completePrograms(const CompletionRequest &request, bool byNumber) {
  std::map<std::string, std::string> programs;
  for (const ProgramInfo &program : request.snapshot.unit().index.programs()) {
    if (byNumber && program.number >= 0)
      programs[std::to_string(program.number)] = "program of this file";
    if (!byNumber && !program.name.empty())
      programs[request.snapshot.source().displayText(program.name)] = "program of this file";
  }
  const std::string &path = request.snapshot.source().path();
  if (const auto &folders = request.snapshot.setup().folders; folders && !path.empty()) {
    const ProgramFolders::Programs &beside =
        folders->programs(llvm::sys::path::parent_path(path).str());
    if (byNumber)
      for (const auto &[number, file] : beside.byNumber)
        programs.try_emplace(std::to_string(number), llvm::sys::path::filename(file).str());
    // Only these controls call programs by their bare name.
    else if (request.dialect().reader == "sinumerik")
      for (const auto &entry : beside.byName)
        programs.try_emplace(entry.first().str(), llvm::sys::path::filename(entry.second).str());
  }
  size_t count = 0;
  for (const auto &[name, detail] : programs) {
    if (++count > mostPrograms)
      break;
    CompletionItem item;
    item.kind = CompletionKind::Program;
    item.rank = byNumber ? uint8_t(rankName) : uint8_t(rankOther);
    item.label = name;
    item.detail = detail;
    request.add(std::move(item));
  }
}

void completeStatements(const CompletionRequest &request) {
  const Dialect &dialect = request.dialect();
  if (dialect.reader == "ecs")
    return addStatements(request, angleStatements);
  if (dialect.reader == "sinumerik") {
    addStatements(request, jumpStatements);
    if (dialect.lexical.structures)
      addStatements(request, highLevelStatements);
    return;
  }
  if (dialect.reader != "iso" || !dialect.lexical.macro)
    return;
  if (dialect.lexical.flowWords)
    addStatements(request, wordStatements);
  else
    addStatements(request, macroStatements);
}

} // namespace ncvet::lsp
