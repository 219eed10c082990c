#include "recipe/plan.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>

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

// One image in, one of the same windows, channels and kind out.
const Strings kKeepHeader = {
    "addc",     "subc",         "mulc",     "divc",     "absdiffc",    "powc",        "maxc",
    "minc",     "abs",          "clamp",    "exposure", "tonemap",     "calibrate",   "attrib",
    "sattrib",  "eraseattrib",  "caption",  "keyword",  "label",       "ociodisplay", "ociolook",
    "ccmatrix", "colorconvert", "saturate", "invert",   "iscolorspace"};
// A reference and a test in, a float map of one channel on top.
const Strings kMakeMap = {"hdrflip", "ldrflip"};
// What they print or set changes no image's header.
const Strings kSettings = {"colorconfig", "echo", "v", "q", "nosoftwareattrib"};

struct Planned {
    OIIO::ImageSpec header;
    bool read = true; ///< written in the type of the file that was read last
};

class Plan {
public:
    Plan(Strings words, std::string folder)
        : m_words(std::move(words)),
          m_folder(std::move(folder)) {}

    std::optional<OIIO::ImageSpec> run() {
        runs::know_all_commands();
        while (m_next < m_words.size()) {
            const std::string& word = m_words[m_next++];
            if (!is_plain(word) || !(word[0] == '-' ? command(word) : file(word)))
                return std::nullopt;
        }
        if (m_stack.empty())
            return std::nullopt;
        Planned& top = m_stack.back();
        top.header.set_format(top.read ? m_read_type : OIIO::TypeFloat);
        return top.header;
    }

private:
    // Neither an {expression} nor a wildcard.
    static bool is_plain(const std::string& word) {
        return !word.empty() && word.find('{') == std::string::npos && !sequence::is_pattern(word);
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

    bool command(const std::string& word) {
        const Token token = parse_token(word);
        const chain::Command* row = chain::find_command(token.name);
        if (!row || !token.value.empty())
            return false;
        const Call call(*row, token, {});
        const std::string& name = row->names.front();
        for (size_t i = 0; i < row->args.size(); ++i, ++m_next)
            if (m_next >= m_words.size() || !is_plain(m_words[m_next]))
                return false;
        const bool keeps = has(kKeepHeader, name) && !m_stack.empty();
        return keeps || has(kSettings, name) || (has(kMakeMap, name) && map(call));
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

    Strings m_words;
    std::string m_folder;
    size_t m_next = 0;
    std::vector<Planned> m_stack; ///< the top is the last
    OIIO::TypeDesc m_read_type;
};

} // namespace

std::optional<OIIO::ImageSpec> planned_header(const Source& source) {
    try {
        const Nesting nesting(source.file);
        return Plan(parse(read_text(source.file), source.parameters),
                    std::filesystem::path(source.file).parent_path().string())
            .run();
    } catch (const std::exception&) {
        return std::nullopt; // running the chain tells
    }
}

} // namespace tonetool::recipe
