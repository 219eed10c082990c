// SPDX-License-Identifier: BSD-3-Clause
// What is approved of one case: "hair/long.approved.json".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tonetool::store {

inline constexpr char kRecordEnding[] = ".approved.json";

struct ApprovedImage {
    std::string key;    ///< which of several accepted images, "cuda"; empty: of all without a key
    std::string file;   ///< beside the record
    std::string sha256; ///< of the file's bytes, as git-lfs has it
    uint64_t bytes = 0;
    std::string by, at, reason;        ///< who, when (UTC) and why
    std::vector<std::string> replaces; ///< the hashes that it was approved in place of
};

struct ApprovedRecord {
    std::vector<ApprovedImage> images; ///< by key, then hash
};

/// A field a line, so that git merges approvals of different cases.
std::string record_text(ApprovedRecord record);
/// Throws a runtime_error that says what is wrong, as the end of a sentence about the file.
ApprovedRecord record_from(const std::string& text);

} // namespace tonetool::store
