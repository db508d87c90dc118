// The records of tables and machine profiles: every key that they may have, with what it is for.
#pragma once

#include "formats/dialect/control_facts.h"
#include "formats/dialect/machine.h"
#include "formats/dialect/shape.h"

namespace ncvet {

class DialectBuilder;

/// Marks of programs for a control, and the endings of their files.
struct ProgramMarks {
  std::vector<DetectMark> marks;
  std::vector<std::string> extensions; ///< without the dot
};

/// A control without a table.
struct OtherControlFile : ProgramMarks {
  std::string readAs; ///< id of the dialect that is nearest to it; empty: what the text looks like
  bool forMachine = true; ///< false: no machine runs such a text
  bool alike = false;     ///< its language is nearly that of the dialect that it is read as
  std::optional<Severity> highest;
};

// dialect_records.cpp
extern const RecordOf<Dialect> dialectRecord;
extern const RecordOf<Lexical> lexicalRecord;
extern const RecordOf<AddressInfo> addressRecord;
extern const RecordOf<GroupInfo> groupRecord;
extern const RecordOf<SwitchInfo> switchRecord;
extern const RecordOf<RuleOverride> ruleRecord;
extern const RecordOf<ProgramMarks> detectionRecord;
extern const RecordOf<OtherControlFile> otherControlRecord;

// fact_records.cpp
extern const RecordOf<ControlFacts> factRecord;

// program_fact_records.cpp
extern const RecordOf<MessageFacts> messageFactRecord;
extern const RecordOf<ProgramFacts> programFactRecord;
extern const RecordOf<TextFacts> textFactRecord;
extern const RecordOf<VariableFacts> variableFactRecord;

// code_records.cpp
extern const RecordOf<CodeInfo> codeRecord;
extern const RecordOf<Variant> variantRecord; ///< what it has besides the keys of its code
extern const RecordOf<Condition> conditionRecord;
extern const RecordOf<Notice> noticeRecord;
extern const RecordOf<WordSpec> wordRecord;
extern const RecordOf<Store> storeRecord;
extern const RecordOf<SwitchEffect> switchEffectRecord;
extern const Shape noticesShape; ///< notices, and names of lists that several codes share

// machine_records.cpp
extern const RecordOf<MachineProfile> machineRecord;
extern const RecordOf<AxisLimits> axisRecord;
extern const RecordOf<ToolData> toolRecord;
extern const Record machineOptionRecord; ///< options of machine profiles, of all dialects

} // namespace ncvet
