// Commands that read and write images.
#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <cstdio>

#include "chain/channels.h"
#include "chain/error.h"
#include "chain/first_part.h"
#include "chain/inspect.h"
#include "chain/io.h"
#include "chain/output.h"

namespace tonetool::chain {

void push_file(Session& session, const std::string& filename) {
    ImagePtr image = Image::open(filename, session.input);
    if (!session.first_format) {
        session.first_format = image->part().format();
    }
    session.push(image);
    inspect_if_asked(session, *image);
}

void push_file_or_label(Session& session, const std::string& word) {
    auto labelled = session.labels.find(word);
    if (labelled != session.labels.end()) {
        session.push(labelled->second);
    } else {
        push_file(session, word);
    }
}

void check_outputs(const Session& session) {
    for (const auto& [name, type] : session.output.type_of_channel) {
        if (session.output.matched_channels.count(name) == 0) {
            throw CommandError("-d " + name + "=...: no image written after it has a channel \"" +
                               name + "\"");
        }
    }
}

namespace {

// Settings of one -i, put back when it is done.
struct InfoForOne {
    InfoForOne(Session& the_session, int level) : session(the_session), before(session.list) {
        session.list.info = session.list.info || level > 0;
        session.list.verbose = session.list.verbose || level > 1;
    }
    ~InfoForOne() { session.list = before; }
    Session& session;
    Listing before;
};

void run_input(Session& session, const Call& call) {
    int level = call.integer("info", {0, 2}).value_or(0);
    {
        InfoForOne settings(session, level);
        push_file(session, call.argument(0));
    }
    if (auto list = call.text("ch")) {
        ImagePtr whole = session.stack.back();
        warn_of_other_parts(session, call, *whole);
        session.stack.back() =
            Image::derived(*whole, select_channels(whole->part().pixels(), *list));
    }
}

OutputSettings settings_of(const Session& session, const Call& call) {
    OutputSettings settings = session.output;
    if (auto name = call.text("datatype")) {
        settings.type = parse_data_type("data format", *name);
        settings.type_of_channel.clear();
    }
    if (auto compression = call.text("compression")) {
        check_compression(*compression);
        settings.compression = *compression;
    }
    return settings;
}

// A printf pattern with exactly one %d or %0Nd, filled in.
std::string numbered_name(const std::string& pattern, int number) {
    size_t percent = pattern.find('%');
    size_t end = percent == std::string::npos
                     ? percent
                     : pattern.find_first_not_of("0123456789", percent + 1);
    bool valid = end != std::string::npos && pattern[end] == 'd' && end - percent < 4 &&
                 pattern.find('%', end) == std::string::npos;
    if (!valid) {
        throw CommandError("all= needs one %d in the file name (\"" + pattern +
                           "\"; valid: out.%d.exr, out.%04d.exr)");
    }
    std::string width = pattern.substr(percent + 1, end - percent - 1);
    std::string digits = std::to_string(number);
    size_t wanted = width.empty() ? 0 : std::stoul(width);
    char pad = !width.empty() && width[0] == '0' ? '0' : ' ';
    digits.insert(0, wanted > digits.size() ? wanted - digits.size() : 0, pad);
    return pattern.substr(0, percent) + digits + pattern.substr(end + 1);
}

void write_one(Session& session, const Call& call, const Image& image,
               const std::string& filename) {
    if (session.verbose) {
        session.print("Writing " + filename);
    }
    write_output(session, call.row().label(), image, filename, settings_of(session, call));
}

void run_output(Session& session, const Call& call) {
    session.push(call.images.front());
    if (auto first = call.integer("all", {0, 1e9})) {
        std::vector<ImagePtr> all = session.stack;
        for (const ImagePtr& image : all) {
            int index = static_cast<int>(&image - all.data());
            write_one(session, call, *image, numbered_name(call.argument(0), *first + index));
        }
        return;
    }
    write_one(session, call, *call.images.front(), call.argument(0));
}

void run_data_type(Session& session, const Call& call) {
    OutputSettings& output = session.output;
    const std::string& text = call.argument(0);
    if (text.find('=') == std::string::npos) {
        output.type = parse_data_type("data format", text);
        output.type_of_channel.clear();
        return;
    }
    for (const std::string& word : split(text, ',')) {
        size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw CommandError("Malformed format designator \"" + word +
                               "\" (valid: TYPE or CHANNEL=TYPE)");
        }
        output.type_of_channel[word.substr(0, equals)] =
            parse_data_type("data format", word.substr(equals + 1));
    }
}

void run_compression(Session& session, const Call& call) {
    check_compression(call.argument(0));
    session.output.compression = call.argument(0);
}

} // namespace

std::vector<Command> io_commands() {
    const std::string types = join(data_type_names(), "|");
    return {
        {{{"i"}, {"FILENAME"}, 0, 1, Group::Read},
         {{"ch", "CHANLIST", "keep these channels only, as --ch"},
          {"info", "0|1|2", "print information about the file; 2: with its metadata"}},
         "Read an image (as a bare file name does)",
         run_input},
        {{{"o"}, {"FILENAME"}, 1, 1, Group::Write},
         {{"datatype", types, "data type of this file"},
          {"compression", "NAME", "compression of this file, name or name:quality"},
          {"all", "N", "write all images of the stack; the file name has a %d, from N on"}},
         "Write the current image",
         run_output,
         false},
        {{{"d"}, {"TYPE"}, 0, 0, Group::Write},
         {},
         "Data type of the outputs that follow, or CHAN=TYPE of one channel (" + types + ")",
         run_data_type},
        {{{"compression"}, {"NAME"}, 0, 0, Group::Write},
         {},
         "Compression of the outputs that follow, name or name:quality",
         run_compression},
    };
}

} // namespace tonetool::chain
