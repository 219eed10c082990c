// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_text.h"

#include <OpenImageIO/strutil.h>
#include <stdexcept>

#include "imagebuf/pixels/utf8.h"
#include "sequence/page/files.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

std::string hash_source(const std::string& hex) {
    std::string bytes;
    for (size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return "'sha256-" + OIIO::Strutil::base64_encode(bytes) + "'";
}

} // namespace

std::string escaped(const std::string& text) {
    std::string html;
    for (const char c : valid_utf8(text)) {
        switch (c) {
        case '&':
            html += "&amp;";
            break;
        case '<':
            html += "&lt;";
            break;
        case '>':
            html += "&gt;";
            break;
        case '"':
            html += "&quot;";
            break;
        case '\'':
            html += "&#39;";
            break;
        default:
            html += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return html;
}

std::string script_data(const std::string& json) {
    if (json.find_first_of("<>&") == std::string::npos) // as in pictures, which are long
        return json;
    std::string data;
    data.reserve(json.size());
    for (const char c : json) {
        switch (c) {
        case '<':
            data += "\\u003c";
            break;
        case '>':
            data += "\\u003e";
            break;
        case '&':
            data += "\\u0026";
            break;
        default:
            data += c;
        }
    }
    return data;
}

std::string filled(const std::string& text, const std::map<std::string, std::string>& values) {
    std::string result;
    size_t at = 0;
    for (;;) {
        const size_t open = text.find("{{", at);
        const size_t close = text.find("}}", open);
        if (open == std::string::npos || close == std::string::npos)
            return result + text.substr(at);
        const std::string name = text.substr(open + 2, close - open - 2);
        const auto value = values.find(name);
        if (value == values.end())
            throw std::runtime_error("the page has no value for \"" + name + "\"");
        result.append(text, at, open - at).append(value->second);
        at = close + 2;
    }
}

std::string page_policy() {
    return format("default-src 'none'; img-src data:; style-src {}; script-src {} {}; "
                  "base-uri 'none'; form-action 'none'",
                  hash_source(page::style_hash), hash_source(page::script_hash),
                  hash_source(page::chart_hash));
}

std::string page_class(Status status) {
    return status > Status::Failed ? "error" : status_name(status);
}

std::string page_sign(Status status) {
    return status == Status::Missing ? "missing" : page_class(status);
}

} // namespace tonetool::sequence
