// SPDX-License-Identifier: BSD-3-Clause
// Bytes as text, for JSON and for data URIs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tonetool::sequence {

std::string base64(const std::vector<unsigned char>& bytes);
/// From the character at `begin`; it stops at the first one outside of the alphabet: the padding.
std::vector<unsigned char> bytes_of_base64(const std::string& text, size_t begin = 0);

} // namespace tonetool::sequence
