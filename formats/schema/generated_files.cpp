// Which files are made of which records.
#include "formats/schema/generated_files.h"

#include "formats/dialect/config_file.h"
#include "formats/schema/controls_writer.h"
#include "formats/schema/reference_writer.h"
#include "formats/schema/schema_writer.h"

namespace ncvet {

std::vector<GeneratedFile> generatedFiles() {
  return {
      {"schema/dialect.schema.json", schemaText(dialectRecord, "dialect.schema.json")},
      {"schema/machine.schema.json", schemaText(machineRecord, "machine.schema.json")},
      {"schema/config.schema.json", schemaText(configRecord, "config.schema.json")},
      {"schema/profile.schema.json", schemaText(profileRecord, "profile.schema.json")},
      {"schema/detect.schema.json", schemaText(detectRecord, "detect.schema.json")},
      {"REFERENCE.md", referenceText({&dialectRecord, &machineRecord})},
      {"../docs/controls.md", controlsText()},
  };
}

} // namespace ncvet
