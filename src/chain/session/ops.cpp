// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/ops.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>

namespace tonetool::chain {

namespace {

// What subimages= asks for: "all", "0,2", "-1" (all but that one), "albedo,-2".
struct Listed {
    std::set<size_t> taken, left_out;
    bool all = false;
    Strings unknown; // names that no subimage has

    bool says_nothing() const { return !all && taken.empty() && left_out.empty(); }
    bool has(size_t subimage) const {
        return (taken.empty() || taken.count(subimage) > 0) && left_out.count(subimage) == 0;
    }
};

Listed listed(const std::string& text, const Image& image) {
    Listed found;
    for (const std::string& given : split(text, ',')) {
        std::string word = OIIO::Strutil::strip(given);
        const bool except = word.size() > 1 && word.front() == '-';
        word.erase(0, except ? 1 : 0);
        if (OIIO::Strutil::iequals(word, "all")) {
            found = {{}, {}, true, found.unknown};
            continue;
        }
        const auto named =
            std::find_if(image.parts().begin(), image.parts().end(), [&](const PartPtr& part) {
                return part->header().get_string_attribute("oiio:subimagename") == word;
            });
        const auto index = parse_integer(word);
        if (!index && named == image.parts().end()) {
            found.unknown.push_back(word);
            continue;
        }
        (except ? found.left_out : found.taken)
            .insert(index ? size_t(*index) : size_t(named - image.parts().begin()));
    }
    return found;
}

OIIO::ImageBuf made(Session& session, const Call& call, const Kernel& kernel, int subimage,
                    int level, bool& changed) {
    OIIO::ImageBuf result;
    Op op{session, call, result, {}, subimage};
    for (const ImagePtr& image : call.images) {
        Part& part = image->part(std::min(size_t(subimage), image->part_count() - 1));
        op.src.push_back(&part.pixels(std::min(level, part.mip_levels() - 1)));
    }
    bool done = kernel(op);
    if (!done || result.has_error())
        throw CommandError(result.has_error() ? result.geterror() : "failed");
    if (op.unchanged)
        result.copy(op.a());
    for (size_t i = 1; i < op.src.size() && session.settings.metamerge; ++i)
        result.specmod().extra_attribs.merge(op.src[i]->spec().extra_attribs);
    changed |= !op.unchanged;
    return result;
}

} // namespace

Floats Op::list(const std::string& what, const std::string& words) const {
    Floats values;
    for (const std::string& word : split(words, ','))
        values.push_back(float(call.parsed(what, OIIO::Strutil::strip(word), kAnyNumberAtAll)));
    return values;
}

Floats Op::per_channel(const std::string& what, const std::string& words, float rest) const {
    return per_value(what, words, rest, size_t(a().nchannels()));
}

Floats Op::per_value(const std::string& what, const std::string& words, float rest,
                     size_t count) const {
    Floats values(count, rest);
    if (session.settings.compat) {
        OIIO::Strutil::extract_from_list_string(values, words);
        values.resize(count, values.size() == 1 ? values.front() : rest);
        return values;
    }
    Strings given = split(words, ',');
    if (given.size() > count && given.size() > 1) { // a colour of a mask, as oiiotool takes it
        session.warning(call.row().label(),
                        what + " \"" + words + "\" has " + std::to_string(given.size()) +
                            " numbers, of which the image's channels use " + std::to_string(count));
        for (const std::string& word : given)
            (void)list(what, OIIO::Strutil::strip(word).empty() ? "0" : word);
        given.resize(std::max<size_t>(count, 1));
    }
    if (given.size() == 1)
        return Floats(count, list(what, words).front());
    for (size_t i = 0; i < given.size(); ++i) // ",,3": the first two stay as they are
        values[i] = OIIO::Strutil::strip(given[i]).empty() ? rest : list(what, given[i]).front();
    return values;
}

Floats Op::values(const std::string& key, float rest) const {
    auto words = call.text(key);
    return words ? per_channel(key, *words, rest) : Floats(size_t(a().nchannels()), rest);
}

Chosen chosen_subimages(const Session& session, const Call& call, const Image& image) {
    const size_t count = image.part_count();
    const auto subimages = call.text("subimages");
    const Listed which = subimages ? listed(*subimages, image) : Listed();
    if (!session.settings.compat && !which.unknown.empty()) {
        throw CommandError("subimages \"" + *subimages + "\": " + image.name() +
                           " has no subimage \"" + which.unknown.front() +
                           "\" (valid: all, numbers from 0, names, -N for all but N)");
    }
    if (which.says_nothing()) {
        bool all = call.flag("allsubimages", session.settings.all_subimages);
        return {all ? count : 1, std::vector<bool>(all ? count : 1, true)};
    }
    Chosen chosen{count, {}};
    for (size_t s = 0; s < count; ++s)
        chosen.active.push_back(which.has(s));
    if (!session.settings.compat &&
        std::count(chosen.active.begin(), chosen.active.end(), true) == 0) {
        throw CommandError("subimages \"" + *subimages + "\" chooses none of the " +
                           std::to_string(count) + " subimages of " + image.name());
    }
    return chosen;
}

void run_kernel(Session& session, const Call& call, const Kernel& kernel, Scope scope) {
    const Image& first = *call.images.front();
    const Chosen chosen = chosen_subimages(session, call, first);
    std::vector<std::vector<OIIO::ImageBuf>> subimages(chosen.count);
    bool changed = false;
    for (size_t s = 0; s < chosen.count; ++s) {
        Part& part = first.part(s);
        const bool all_levels = scope == Scope::Levels && session.settings.all_subimages;
        for (int level = 0; level < (all_levels ? part.mip_levels() : 1); ++level) {
            subimages[s].push_back(chosen.active[s]
                                       ? made(session, call, kernel, int(s), level, changed)
                                       : part.pixels(level).copy(OIIO::TypeUnknown));
        }
    }
    if (!changed) {
        session.stack.push(call.images.front());
        return;
    }
    if (chosen.count == 1 && !session.settings.compat)
        session.warn_of_other_parts(call.row().label(), first);
    ImagePtr result = Image::derived(first, std::move(subimages));
    if (session.settings.compat && !call.operation().empty())
        result->rename(call.operation());
    session.stack.push(std::move(result));
}

ImagePtr with_headers(const Image& image, const Chosen& chosen,
                      const std::function<void(OIIO::ImageSpec&)>& edit) {
    std::vector<PartPtr> parts = image.parts();
    for (size_t s = 0; s < chosen.count; ++s)
        if (chosen.active[s])
            parts[s] = Part::with_headers(parts[s], edit);
    return std::make_shared<Image>(image.name(), std::move(parts));
}

Row on_pixels(const std::string& usage, int images, std::string help, Kernel kernel, Scope scope) {
    const auto run = [kernel, scope](Session& session, const Call& call) {
        run_kernel(session, call, kernel, scope);
    };
    const std::string name = usage.substr(0, usage.find_first_of("| "));
    return command(usage, std::move(help), run)
        .images(images, 1)
        .operation("-" + name)
        .of_subimages();
}

Row on_headers(const std::string& usage, std::string help, Edit edit) {
    const auto run = [edit](Session& session, const Call& call) {
        const Image& image = *call.images.front();
        session.stack.push(with_headers(image, chosen_subimages(session, call, image),
                                        [&](OIIO::ImageSpec& spec) { edit(spec, call, session); }));
    };
    return command(usage, std::move(help), run).images(1, 1).of_subimages();
}

bool adjust_window(Session& session, const Call& call, const std::string& text, Geometry allowed,
                   OIIO::ROI& window) {
    const Adjusted adjusted = adjust_window(text, allowed, window, session.settings.compat);
    if (!adjusted.error.empty())
        throw CommandError(adjusted.error, call.text());
    if (!adjusted.warning.empty())
        session.warning(call.text(), adjusted.warning);
    return adjusted.warning.empty();
}

std::vector<ImagePtr> take_images(Session& session, size_t count) {
    const bool some = count > 0;
    count = count == 0 ? std::max(session.stack.images.size(), size_t(1)) : count;
    if (session.stack.images.size() < count)
        throw CommandError(session.stack.lacks(int(count)));
    std::vector<ImagePtr> images = session.stack.pop(count);
    for (const ImagePtr& image : images) {
        image->used = true;
        if (some || !session.settings.compat) // oiiotool does not look at the types of "all"
            session.note_format(*image);
    }
    return images;
}

} // namespace tonetool::chain
