// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/plan.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>

#include "chain/language/line.h"
#include "chain/session/call.h"
#include "recipe/nesting.h"
#include "runs/runs.h"
#include "sequence/frames/file_sequence.h"

namespace tonetool::recipe {

namespace {

using chain::Call;

bool has(const Strings& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

struct Planned {
    OIIO::ImageSpec header;
    bool read = true; ///< written in the type of the file that was read last
};

class Plan {
public:
    Plan(Strings words, std::string folder)
        : m_line(chain::parse_line(std::move(words))),
          m_folder(std::move(folder)) {}

    std::optional<OIIO::ImageSpec> run() {
        for (const chain::Word& word : m_line.words)
            if (!is_plain(word) || !(word.token.is_command ? command(word) : file(word.token.text)))
                return std::nullopt;
        if (m_stack.empty())
            return std::nullopt;
        Planned& top = m_stack.back();
        top.header.set_format(top.read ? m_read_type : OIIO::TypeFloat);
        return top.header;
    }

private:
    // Neither an {expression} nor a wildcard in it or its arguments.
    bool is_plain(const chain::Word& word) const {
        const auto begin = m_line.texts.begin();
        return std::all_of(begin + std::ptrdiff_t(word.at), begin + std::ptrdiff_t(word.end()),
                           [](const std::string& text) {
                               return !text.empty() && text.find('{') == std::string::npos &&
                                      !sequence::is_pattern(text);
                           });
    }

    bool file(const std::string& name) {
        auto input = OIIO::ImageInput::open((std::filesystem::path(m_folder) / name).string());
        if (!input) {
            (void)OIIO::geterror();
            return false;
        }
        const OIIO::ImageSpec header = input->spec_dimensions(0, 0);
        m_read_type = header.format;
        m_stack.push_back({header});
        const bool one = !header.deep && header.width > 0 && !input->seek_subimage(1, 0);
        (void)input->geterror();
        return one;
    }

    bool command(const chain::Word& word) {
        const Token& token = word.token;
        if (!word.row || !word.missing.empty() || !token.problem.empty() || !token.value.empty())
            return false;
        const Call call(*word.row, token, {});
        const bool keeps = word.row->keeps_header && (word.row->pops == 0 || !m_stack.empty());
        return keeps || (word.row->makes_map && map(call));
    }

    // Thresholds decide whether there is a picture at all.
    bool map(const Call& call) {
        const Strings only = {"ppd",           "tonemapper",   "exposuremap",
                              "startExposure", "stopExposure", "numExposures"};
        for (const chain::Modifier& modifier : call.row().modifiers)
            if (call.has(modifier.key) && !has(only, modifier.key))
                return false;
        if (m_stack.size() < 2 || call.pops() != 2)
            return false;
        const OIIO::ImageSpec test = m_stack.back().header;
        m_stack.pop_back();
        const OIIO::ImageSpec reference = m_stack.back().header;
        m_stack.pop_back();
        const auto size = [](const OIIO::ROI& a) { return std::make_pair(a.width(), a.height()); };
        const OIIO::ROI window = reference.roi_full();
        OIIO::ImageSpec header(reference.width, reference.height, 1, OIIO::TypeFloat);
        header.x = header.full_x = reference.x;
        header.y = header.full_y = reference.y;
        m_stack.push_back({header, false});
        return size(reference.roi()) == size(window) && reference.roi() == test.roi() &&
               size(test.roi_full()) == size(window);
    }

    chain::ParsedLine m_line;
    std::string m_folder;
    std::vector<Planned> m_stack; ///< the top is the last
    OIIO::TypeDesc m_read_type;
};

} // namespace

std::optional<OIIO::ImageSpec> planned_header(const Source& source) {
    try {
        const Nesting nesting(source.file);
        runs::know_all_commands();
        return Plan(parse(read_text(source.file), source.parameters),
                    std::filesystem::path(source.file).parent_path().string())
            .run();
    } catch (const std::exception&) {
        return std::nullopt; // running the chain tells
    }
}

} // namespace tonetool::recipe
