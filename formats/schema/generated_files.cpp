// Which files are made of which records.
#include "formats/schema/generated_files.h"

#include "formats/dialect/records.h"
#include "formats/schema/reference_writer.h"
#include "formats/schema/schema_writer.h"

namespace ncvet {

std::vector<GeneratedFile> generatedFiles() {
  return {
      {"schema/dialect.schema.json", schemaText(dialectRecord, "dialect.schema.json")},
      {"schema/machine.schema.json", schemaText(machineRecord, "machine.schema.json")},
      {"REFERENCE.md", referenceText({&dialectRecord, &machineRecord})},
  };
}

} // namespace ncvet
