// SPDX-License-Identifier: BSD-3-Clause
// Commands that decide which of the others run: variables, conditions, loops, frames.
#include <OpenImageIO/strutil.h>

#include "chain/commands/commands.h"
#include "chain/images/attributes.h"
#include "chain/language/arithmetic.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// The depth to which --if, --for and --while may be nested.
constexpr size_t kMostNestedBlocks = 100;

void push_block(Session& session, const Block& block) {
    if (session.flow.blocks.size() == kMostNestedBlocks) {
        throw CommandError("nested deeper than " + std::to_string(kMostNestedBlocks) +
                           ", the most that --if, --for and --while may be");
    }
    session.flow.blocks.push_back(block);
}

void begin_block(Session& session, const std::string& kind, const Call& call) {
    bool outside = session.flow.running();
    push_block(session,
               {kind, session.flow.command, outside && is_true(call.argument(0)), outside});
}

Block& innermost(Session& session, const std::string& end, const std::string& kind) {
    std::vector<Block>& blocks = session.flow.blocks;
    if (blocks.empty() || blocks.back().kind != kind)
        throw CommandError(end + " without matching " + kind);
    return blocks.back();
}

void run_else(Session& session, const Call&) {
    Block& block = innermost(session, "else", "if");
    block.running = block.outside && !block.running;
}

void run_endif(Session& session, const Call&) {
    innermost(session, "endif", "if");
    session.flow.blocks.pop_back();
}

// Goes back to the --while, whose argument is evaluated again.
void run_endwhile(Session& session, const Call&) {
    Block block = innermost(session, "endwhile", "while");
    session.flow.blocks.pop_back();
    session.flow.next = block.running ? block.begin : session.flow.next;
}

bool set_loop_variable(Session& session, Block& block, const std::string& name) {
    session.stack.variables.attribute(name, expression_number(block.value));
    block.running =
        block.outside && (block.step < 0 && !session.settings.compat ? block.value > block.end
                                                                     : block.value < block.end);
    return block.running;
}

void run_for(Session& session, const Call& call) {
    Block block{"for", session.flow.next, false, session.flow.running(), call.argument(0)};
    if (block.outside) {
        std::vector<double> range;
        for (const std::string& word : split(call.argument(1), ',')) {
            bool lenient = session.settings.compat && !parse_number(word);
            range.push_back(lenient ? 0 : checked_number("RANGE", word, {-1e9, 1e9}));
        }
        if (range.size() > 3)
            throw CommandError("Invalid range \"" + call.argument(1) + "\"");
        block.value = range.size() > 1 ? range[0] : 0;
        block.end = range.size() > 1 ? range[1] : range[0];
        block.step = range.size() > 2 ? range[2] : 1;
        if (block.step == 0 && !session.settings.compat)
            throw CommandError("RANGE \"" + call.argument(1) + "\" never ends: its step is 0");
        set_loop_variable(session, block, call.argument(0));
    }
    push_block(session, block);
}

void run_endfor(Session& session, const Call&) {
    Block& block = innermost(session, "endfor", "for");
    block.value += block.step;
    if (block.running && set_loop_variable(session, block, block.variable))
        session.flow.next = block.begin;
    else
        session.flow.blocks.pop_back();
}

void run_set(Session& session, const Call& call) {
    const std::string& name = call.argument(0);
    const std::string& value = call.argument(1);
    std::string type = call.text("type").value_or("");
    bool number = type.empty() && parse_number(value);
    bool whole = number && parse_integer(value);
    if (type == "int" || whole) {
        session.stack.variables.attribute(name, OIIO::Strutil::stoi(value));
    } else if (type == "float" || number) {
        session.stack.variables.attribute(name, OIIO::Strutil::stof(value));
    } else if (type.empty() || type == "string") {
        session.stack.variables.attribute(name, value);
    } else if (const OIIO::TypeDesc packed(type);
               packed == OIIO::TypeTimeCode || packed == OIIO::TypeRational) {
        OIIO::ImageSpec spec;
        set_attribute(spec, name, value, packed);
        session.stack.variables.merge(spec.extra_attribs, true);
    } else {
        session.stack.variables.attribute(name, OIIO::TypeDesc(type), value);
    }
}

const Rows kControlRows = {
    command("set NAME VALUE", "Set a variable, the {NAME} of expressions", run_set)
        .modifier("type", "TYPE", "its data type: int, float, string, ... (as it looks)"),
    command("if VALUE", "Run what follows, to --else or --endif, if VALUE is not 0 or empty",
            [](Session& session, const Call& call) { begin_block(session, "if", call); })
        .control(),
    command("else", "Run what follows, to --endif, if the --if did not", run_else).control(),
    command("endif", "End of an --if", run_endif).control(),
    command("while VALUE", "Repeat what follows, to --endwhile, while VALUE is true",
            [](Session& session, const Call& call) { begin_block(session, "while", call); })
        .control(),
    command("endwhile", "End of a --while", run_endwhile).control(),
    command("for VARIABLE RANGE",
            "Repeat what follows, to --endfor, for numbers: END, BEGIN,END or BEGIN,END,STEP",
            run_for)
        .control(),
    command("endfor", "End of a --for", run_endfor).control(),
    command("evaloff", "Leave {expressions} as they are in what follows",
            [](Session& session, const Call&) { session.settings.evaluate = false; }),
    command("evalon", "Replace {expressions} by their values in what follows",
            [](Session& session, const Call&) { session.settings.evaluate = true; }),
    command("frames RANGE", "Run the command line for each of these frames (1-10, 1,3,5-9, 1-10x2)")
        .whole_line()
        .manner(),
    command("framepadding DIGITS", "Digits of frame numbers in file names, 1 to 9").whole_line(),
    command("views NAMES", "Views that %V and %v stand for (left,right)").whole_line(),
    command("wildcardoff", "What follows has no wildcards for frames and views").whole_line(),
    command("wildcardon", "What follows has wildcards for frames and views again").whole_line(),
    command("skip-bad-frames", "After an error go on with the next frame").whole_line().manner(),
    command("parallel-frames|jobs [N]",
            "Work on N frames at a time, on one per core without N; --memory is for all of them")
        .whole_line()
        .manner(),
    command(
        "progress =FORMAT",
        "Report frames done, rate and time left to the standard error (--progress=json: as JSON)")
        .whole_line()
        .manner(),
    command("compat", "Be as lenient as oiiotool, with its messages and exit status").whole_line(),
};

} // namespace

Rows control_commands() {
    return kControlRows;
}

} // namespace tonetool::chain
