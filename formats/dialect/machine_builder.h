// Reads the parts of a machine profile that are lists by name or number.
#pragma once

#include "formats/dialect/json_reader.h"
#include "formats/dialect/machine.h"

namespace ncvet {

llvm::ArrayRef<llvm::StringLiteral> toolKindNames();

void readToolKind(JsonReader &in, const Json &value, ToolData &tool);
void readAxes(JsonReader &in, const Json &axes, MachineProfile &profile);
void readTools(JsonReader &in, const Json &tools, MachineProfile &profile);
void readOffsets(JsonReader &in, const Json &offsets, MachineProfile &profile);
/// Codes are read when the profile is laid over its dialect; here they only must be an object.
void checkMachineCodes(JsonReader &in, const Json &codes, MachineProfile &profile);
void readMachineOptions(JsonReader &in, const Json &options, MachineProfile &profile);

} // namespace ncvet
