// From a stack entry to a file: data types, what the format can hold, metadata.
#pragma once

#include <string>

#include "chain/session.h"
#include "chain/text.h"

namespace tonetool::chain {

/// Names of the data types of -d.
const Strings& data_type_names();
/// The type of that name; a CommandError that lists the valid ones otherwise.
NamedType parse_data_type(const Session& session, const std::string& name);

/// Check a compression, "name" or "name:quality"; a CommandError if it cannot be one.
void check_compression(const std::string& compression);

/// The data types of a part in a file, if nothing else is asked for.
DataFormat format_of(const Session& session, const Part& part);
/// The data type that a subimage would be written with, where the file format has it.
OIIO::TypeDesc output_type(Session& session, const Part& part);

/// Write an image with these settings; a CommandError if that fails, and then the file that was
/// there is untouched. `where` is the command that warnings name.
void write_output(Session& session, const std::string& where, const Image& image,
                  const std::string& filename, const OutputSettings& settings);

} // namespace tonetool::chain
