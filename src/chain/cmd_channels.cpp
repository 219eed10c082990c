// Commands that choose channels and subimages.
#include <algorithm>

#include "chain/call.h"
#include "chain/channels.h"
#include "chain/error.h"
#include "chain/first_part.h"
#include "chain/session.h"

namespace tonetool::chain {

namespace {

void run_ch(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    warn_of_other_parts(session, call, image);
    session.push(Image::derived(image, select_channels(image.part().pixels(), call.argument(0))));
}

void run_chnames(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    warn_of_other_parts(session, call, image);
    OIIO::ImageBuf renamed = image.part().pixels();
    Strings& names = renamed.specmod().channelnames;
    Strings wanted = split(call.argument(0), ',');
    if (wanted.size() > names.size()) {
        throw CommandError("\"" + call.argument(0) + "\" names " + std::to_string(wanted.size()) +
                           " channels, the image has " + std::to_string(names.size()));
    }
    for (size_t c = 0; c < wanted.size(); ++c) {
        names[c] = wanted[c].empty() ? names[c] : wanted[c];
    }
    Strings sorted = names;
    std::sort(sorted.begin(), sorted.end());
    auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
        throw CommandError("two channels would be called \"" + *twice + "\"");
    }
    session.push(Image::derived(image, std::move(renamed)));
}

size_t subimage_index(const Image& image, const std::string& which) {
    if (parse_integer(which)) {
        int last = static_cast<int>(image.part_count()) - 1;
        return static_cast<size_t>(checked_integer("subimage", which, {0.0, last + 0.0}));
    }
    Strings names;
    for (size_t i = 0; i < image.part_count(); ++i) {
        names.push_back(image.part(i).header().get_string_attribute("oiio:subimagename"));
        if (names.back() == which) {
            return i;
        }
    }
    throw CommandError("no subimage \"" + which + "\" in " + image.name() + " (valid: 0 to " +
                       std::to_string(image.part_count() - 1) + ", " + join(names, ", ") + ")");
}

void run_subimage(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    size_t index = subimage_index(image, call.argument(0));
    std::vector<PartPtr> parts{image.parts()[index]};
    if (call.flag("delete", false)) {
        parts = image.parts();
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(index));
        if (parts.empty()) {
            throw CommandError("cannot delete the only subimage of " + image.name());
        }
    }
    session.push(std::make_shared<Image>(image.name(), std::move(parts)));
}

} // namespace

std::vector<Command> channel_commands() {
    return {
        {{{"ch"}, {"CHANLIST"}, 1, 1, Group::Channels},
         {},
         "Select or shuffle channels (\"R,G,B\", \"2,1,0\", \"R,G=0.5,B,A=1.0\", \"Y=G\")",
         run_ch},
        {{{"chnames"}, {"NAMELIST"}, 1, 1, Group::Channels},
         {},
         "Rename the channels (an empty name stays as it is)",
         run_chnames},
        {{{"subimage"}, {"INDEX"}, 1, 1, Group::Channels},
         {{"delete", "0|1", "keep all but this one"}},
         "Select one subimage by index or name",
         run_subimage},
    };
}

} // namespace tonetool::chain
