// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/expression.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "chain/images/attributes.h"
#include "chain/language/arithmetic.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

class Names : public ExpressionNames {
public:
    explicit Names(Session& session) : m_session(session) {}

    std::optional<std::string> value(const std::string& name) override {
        const Frame& frame = m_session.frame;
        if (name == "FRAME_NUMBER")
            return std::to_string(frame.number);
        if (name == "FRAME_NUMBER_PAD")
            return OIIO::Strutil::fmt::format("{:0{}d}", frame.number, frame.padding);
        if (!m_session.stack.variables.contains(name))
            return std::nullopt;
        const OIIO::ParamValue& variable = *m_session.stack.variables.find(name);
        const OIIO::TypeDesc type = variable.type();
        // Of several values oiiotool marks where they begin and end: {1,2,3}, (0.5,0.5,0.5).
        const bool several = type.basevalues() > 1 && type != OIIO::TypeRational &&
                             type != OIIO::TypeTimeCode && type != OIIO::TypeKeyCode;
        const std::string text =
            several ? OIIO::tostring(type, variable.data()) : variable.get_string();
        const bool number = OIIO::Strutil::string_is_float(text);
        return number ? expression_number(double(OIIO::Strutil::stof(text))) : text;
    }
    bool select_top() override {
        m_image = m_session.stack.images.empty() ? nullptr : m_session.stack.top();
        return m_image != nullptr;
    }
    bool select(const std::string& which) override {
        m_image = found(which);
        return m_image != nullptr;
    }
    std::optional<std::string> attribute(const std::string& name) override {
        return attribute_text(*m_image, name);
    }

private:
    ImagePtr found(const std::string& which) const {
        const std::vector<ImagePtr>& stack = m_session.stack.images;
        auto index = parse_integer(which);
        if (index && *index >= 0 && size_t(*index) < stack.size())
            return stack[stack.size() - 1 - size_t(*index)];
        const auto& labels = m_session.stack.labels;
        if (auto labelled = labels.find(which); labelled != labels.end())
            return labelled->second;
        if (which == "TOP" && !stack.empty())
            return stack.back();
        auto named = std::find_if(stack.rbegin(), stack.rend(),
                                  [&](const ImagePtr& image) { return image->name() == which; });
        if (named != stack.rend())
            return *named;
        const std::string file = m_session.file(which);
        return OIIO::Filesystem::exists(file) ? Image::open(file) : nullptr;
    }

    Session& m_session;
    ImagePtr m_image;
};

std::string value_or_text(Session& session, const std::string& text) {
    Names names(session);
    try {
        return evaluated(text, names, session.settings.compat);
    } catch (const CommandError& problem) {
        if (!session.settings.compat)
            throw CommandError(std::string("expression : ") + problem.what());
        session.error("expression", problem.what());
        return text;
    }
}

// Values of variables that hold variables grow without an end.
void check_size(size_t size) {
    if (size > kMostBytesOfAWord) {
        throw CommandError("expression : a word with the values of its {expressions} is longer "
                           "than " +
                           OIIO::Strutil::memformat(kMostBytesOfAWord) +
                           ", the most that it may be");
    }
}

} // namespace

std::string with_values(Session& session, const std::string& word) {
    if (!session.settings.evaluate || word.find('{') == std::string::npos)
        return word;
    Strings plain, nested; // a plain text, an expression, a plain text, ...
    OIIO::string_view rest = word;
    for (size_t brace = rest.find('{'); brace != OIIO::string_view::npos; brace = rest.find('{')) {
        OIIO::string_view behind = rest.substr(brace);
        const OIIO::string_view inner = OIIO::Strutil::parse_nested(behind);
        if (inner.empty())
            break;
        plain.push_back(rest.substr(0, brace));
        nested.push_back(inner.substr(1, inner.size() - 2));
        rest = behind;
    }
    std::string text = rest;
    for (size_t i = nested.size(); i-- > 0;) { // the order of oiiotool's messages
        text = plain[i] + value_or_text(session, nested[i]) + text;
        check_size(text.size());
    }
    return text;
}

} // namespace tonetool::chain
