// SPDX-License-Identifier: BSD-3-Clause
#include "runs/suite_plan.h"

#include <algorithm>
#include <filesystem>

#include "sequence/frames/name_pattern.h"
#include "sequence/results/limits_file.h"
#include "sequence/results/measuring.h"
#include "store/files.h"
#include "store/sha256.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

namespace fs = std::filesystem;
using chain::Group;
using chain::Word;
using sequence::SuiteSetting;
using sequence::SuiteSettings;

// Words end at spaces; '...' and "..." keep them together.
Strings split_words(const std::string& text, const std::string& where) {
    Strings words;
    bool open = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
            open = false;
            continue;
        }
        if (!open)
            words.emplace_back();
        open = true;
        if (c != '\'' && c != '"') {
            words.back() += c;
            continue;
        }
        const size_t end = text.find(c, i + 1);
        if (end == std::string::npos)
            throw CommandError(where + ": " + c + " is not closed in \"" + text + "\"");
        words.back() += text.substr(i + 1, end - i - 1);
        i = end;
    }
    return words;
}

bool has_modifier(const Word& word, const std::string& key) {
    const auto& all = word.row->modifiers;
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.key == key; });
}

const sequence::MeasuringCommand* measures(const Word& word) {
    return word.row ? sequence::measuring_command(word.row->names.front()) : nullptr;
}

// The commands that a row's layer, mask and ignored regions are for.
bool looks_at_pixels(const Word& word) {
    return measures(word) || word.is("qc") || word.is("against");
}

// Beside --suite stands how a line runs and where results go.
void check_beside(const chain::ParsedLine& line) {
    if (line.compat)
        throw CommandError("--suite does not go with --compat, which knows no names");
    for (const Word& word : line.words) {
        const bool manner = word.row && (word.row->group == Group::Check || word.row->manner ||
                                         word.row->of_process || word.is("n"));
        if (!manner) {
            throw CommandError("\"" + line.texts[word.at] +
                               "\" does not go beside --suite, whose file says which images are "
                               "compared and how (valid: where results go, as --report, and how "
                               "it runs, as --parallel-frames)");
        }
    }
}

} // namespace

SuitePlan::SuitePlan(const chain::ParsedLine& line, const Word& word) : m_given(line.texts) {
    check_beside(line);
    const std::string file = line.texts.at(word.arguments.front());
    try {
        m_text = store::read_file(file);
        m_suite = sequence::suite_from(m_text, file);
    } catch (const std::runtime_error& problem) {
        throw CommandError(std::string("--suite: ") + problem.what());
    }
    if (sequence::is_pattern(m_suite.folder) || sequence::has_names(m_suite.folder))
        throw CommandError("--suite: the folder \"" + m_suite.folder +
                           "\" has wildcards in its name (valid: a link to it, or the line in it)");
    if (!sequence::has_names(m_suite.test))
        throw CommandError(place(m_suite.test_line) + "\"" + m_suite.test +
                           "\" has no %N: a suite is of images with names (valid: "
                           "\"renders/%N.exr\")");
    m_sha256 = store::sha256_of(m_text);
    for (const auto& [key, value] : word.token.modifiers)
        if (key == "sha256" && value != m_sha256)
            throw CommandError("--suite: \"" + file + "\" is not the file with sha256=" + value +
                               ": its own is " + m_sha256);
    for (const Word& other : line.words)
        if (other.is("key") && !other.arguments.empty())
            m_key = line.texts[other.arguments.front()];
    std::string reference = m_suite.path(m_suite.reference);
    const bool named = sequence::has_names(m_suite.reference);
    std::error_code none;
    if (!reference.empty() && !named && !sequence::is_pattern(m_suite.reference) &&
        (fs::is_directory(reference, none) || fs::path(reference).extension().empty())) {
        m_store_folder = reference;
        while (m_store_folder.size() > 1 && m_store_folder.back() == '/')
            m_store_folder.pop_back();
        reference = m_store_folder + "/%N.approved"; // of a case without an image: no such file
        refuse_store_among_tests();
        if (sequence::is_pattern(m_suite.test) || m_suite.test.find("%N") == std::string::npos)
            throw CommandError(place(m_suite.test_line) + "\"" + m_suite.test +
                               "\" is compared with the approved images in \"" + m_store_folder +
                               "\", which are of names (valid: %N and %M in test, or a reference "
                               "with the same wildcards, as \"refs/%N.#.exr\")");
    } else if (!m_key.empty()) {
        throw CommandError("--key " + m_key +
                           " chooses approved images, and the suite's "
                           "reference is no folder of them (valid: reference = \"approved\")");
    }
    m_reference_at = m_given.size();
    if (!reference.empty())
        m_given.push_back(reference);
    m_given.push_back(m_suite.path(m_suite.test));
    m_line = line_with(words_of({}));
}

// What was approved would be a case, and be approved in its turn.
void SuitePlan::refuse_store_among_tests() const {
    const auto normal = [](const std::string& path) {
        return fs::path(path).lexically_normal().string();
    };
    const std::string test = normal(sequence::without_range(m_suite.path(m_suite.test)));
    const sequence::NamePattern pattern(test, true);
    const std::string extension = fs::path(test).extension().string();
    if (pattern.match(normal(m_store_folder) + "/x.0123456789ab" + extension, ""))
        throw CommandError(place(m_suite.test_line) + "the folder of approved images \"" +
                           m_store_folder + "\" is where \"" + m_suite.test +
                           "\" looks for tests (valid: a folder beside it)");
}

std::string SuitePlan::place(int line) const {
    return "\"" + m_suite.file + "\"" + (line > 0 ? ", line " + std::to_string(line) : "") + ": ";
}

std::string SuitePlan::case_line(const sequence::Item& item) const {
    return "tonetool --suite " + shell_quoted(m_suite.file) +
           (m_key.empty() ? "" : " --key " + shell_quoted(m_key)) +
           (item.name.empty() ? "" : " --only " + shell_quoted(item.name));
}

Strings SuitePlan::title() const {
    Strings words{"--suite:sha256=" + m_sha256, fs::path(m_suite.file).filename().string()};
    if (!m_key.empty()) {
        words.push_back("--key");
        words.push_back(m_key);
    }
    return words;
}

sequence::SuiteOrigin SuitePlan::origin() const {
    return {m_suite.name, m_suite.file, m_sha256, m_store_folder, m_key, m_suite.test_line};
}

chain::ParsedLine SuitePlan::line_with(const Strings& check) const {
    Strings texts = m_given;
    texts.insert(texts.end(), check.begin(), check.end());
    return chain::parse_line(std::move(texts));
}

// The words of a check, file names as the program opens them.
Strings SuitePlan::check_words(const std::string& text, const std::string& where) const {
    chain::ParsedLine line = chain::parse_line(split_words(text, where));
    Strings labels;
    for (const Word& word : line.words) {
        std::string& typed = line.texts[word.at];
        const bool labelled = std::find(labels.begin(), labels.end(), typed) != labels.end();
        if (!word.row) {
            if (!word.token.is_command && !labelled)
                typed = m_suite.path(typed);
            continue;
        }
        if (word.is("label") && !word.arguments.empty())
            labels.push_back(line.texts[word.arguments.front()]);
        if (word.row->outlives_chain() || word.row->group == Group::Check || word.row->manner ||
            word.row->whole_line || word.is("n") || word.is("compat"))
            throw CommandError(where + "\"" + typed +
                               "\" does not go into check: it writes "
                               "files, or says how the program runs (valid: it beside --suite)");
        for (size_t i = 0; i < word.arguments.size(); ++i)
            if (chain::names_file(word.argument_name(i)))
                line.texts[word.arguments[i]] = m_suite.path(line.texts[word.arguments[i]]);
        for (const auto& [key, value] : word.token.modifiers) {
            const auto& all = word.row->modifiers;
            const auto row = std::find_if(all.begin(), all.end(),
                                          [&key = key](const auto& one) { return one.key == key; });
            const bool limits = (key == "fail" || key == "warn") && measures(word);
            const bool file = limits ? sequence::names_limits_file(value)
                                     : row != all.end() && chain::names_file(row->hint) &&
                                           value.find_first_of("./") != std::string::npos;
            if (file)
                typed = parse_token(typed, true).with_value(key, m_suite.path(value));
        }
    }
    return line.texts;
}

// "hdrflip.mean=0.3,tmqi.Q=0.9", or without the command where there is but one.
void SuitePlan::set_limits(chain::ParsedLine& check, const std::string& key,
                           const SuiteSetting& setting) const {
    std::map<std::string, std::string> of_command;
    for (const std::string& limit : split(setting.text, ',')) {
        const size_t dot = limit.find('.');
        const std::string command = limit.substr(0, std::min(dot, limit.size()));
        const bool named = dot != std::string::npos && sequence::measuring_command(command);
        std::string& list = of_command[named ? command : ""];
        list += (list.empty() ? "" : ",") + (named ? limit.substr(dot + 1) : limit);
    }
    const auto count = std::count_if(check.words.begin(), check.words.end(),
                                     [](const Word& word) { return measures(word) != nullptr; });
    const std::string where = place(setting.line) + key + " = \"" + setting.text + "\"";
    if (count != 1 && of_command.count("") > 0) {
        throw CommandError(where + (count == 0 ? " is a limit, and the check measures nothing"
                                               : " does not say of which command (valid: "
                                                 "hdrflip.mean=0.3)"));
    }
    for (const auto& [command, list] : of_command) {
        bool found = false;
        for (const Word& word : check.words) {
            const auto* measuring = measures(word);
            if (!measuring || (!command.empty() && command != measuring->name))
                continue;
            found = true;
            const std::string value = sequence::names_limits_file(list) ? m_suite.path(list) : list;
            std::string& typed = check.texts[word.at];
            typed = parse_token(typed, true).with_modifier(key, value);
        }
        if (!found)
            throw CommandError(where + ": the check has no " + command);
    }
}

void SuitePlan::set_modifier(chain::ParsedLine& check, const std::string& key,
                             const SuiteSetting& setting) const {
    bool found = false;
    for (const Word& word : check.words) {
        if (!looks_at_pixels(word) || !has_modifier(word, key))
            continue;
        found = true;
        std::string& typed = check.texts[word.at];
        typed = parse_token(typed, true)
                    .with_modifier(key, key == "mask" ? m_suite.path(setting.text) : setting.text);
    }
    if (!found) {
        throw CommandError(place(setting.line) + key + " = \"" + setting.text +
                           "\": no command of the check has " + key + "=");
    }
}

Strings SuitePlan::words_of(const SuiteSettings& settings) const {
    const auto check = settings.find("check");
    const bool own = check != settings.end();
    const std::string where = place(own ? check->second.line : 0) + "check: ";
    chain::ParsedLine line =
        chain::parse_line(check_words(own ? check->second.text : m_suite.check, where));
    for (const auto& [key, setting] : settings)
        if (key == "fail" || key == "warn")
            set_limits(line, key, setting);
        else if (key == "layer" || key == "mask" || key == "ignore")
            set_modifier(line, key, setting);
    return line.texts;
}

const std::map<std::string, SuitePlan::Approved>& SuitePlan::approved() {
    if (!m_approved) {
        m_approved.emplace();
        const store::Store of_suite = store();
        for (const std::string& name : of_suite.names()) {
            Approved& found = (*m_approved)[name];
            try {
                found.images = of_suite.accepted(name, m_key);
            } catch (const std::runtime_error& problem) {
                found.problem = problem.what();
            }
        }
    }
    return *m_approved;
}

sequence::Files SuitePlan::approved_files() {
    const store::Store of_suite = store();
    sequence::Files files;
    files.from_disk = true;
    for (const auto& [name, found] : approved()) {
        if (found.images.empty() && found.problem.empty())
            continue; // only with other keys
        files.items.push_back({0, "", name, ""});
        files.names.push_back(found.problem.empty()
                                  ? of_suite.file(name, found.images.front())
                                  : m_store_folder + "/" + name + store::kRecordEnding);
    }
    for (const std::string& name : of_suite.names_without_record())
        files.lost.push_back({0, "", name, ""});
    return files;
}

void SuitePlan::check_rows(const std::vector<sequence::Item>& cases) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const sequence::Item& item : cases)
        names.emplace_back(item.name, item.method);
    const std::string unmatched = m_suite.unmatched(names);
    if (!unmatched.empty())
        throw CommandError("--suite: " + unmatched);
}

SuiteCasePlan SuitePlan::plan_case(const sequence::Item& item, Strings& words,
                                   const sequence::PatternOptions& options) {
    const SuiteSettings settings = m_suite.settings_of(item.name, item.method);
    const auto text = [&](const char* key) {
        const auto found = settings.find(key);
        return found == settings.end() ? std::string() : found->second.text;
    };
    SuiteCasePlan plan{text("skip")};
    plan.why = text("why");
    for (const char* key : {"check", "fail", "warn"}) // what exceeds it is said of that row
        if (const auto found = settings.find(key); found != settings.end())
            plan.line = found->second.line;
    const bool changes = std::any_of(settings.begin(), settings.end(), [](const auto& setting) {
        return setting.first != "skip" && setting.first != "why";
    });
    const size_t first = m_reference_at + (m_suite.reference.empty() ? 1 : 2);
    const Strings check = changes ? words_of(settings) : Strings();
    if (changes &&
        check != Strings(m_line.texts.begin() + std::ptrdiff_t(first), m_line.texts.end())) {
        auto& own = m_own[check];
        if (!own) {
            chain::ParsedLine line = line_with(check);
            CheckPlan planned = plan_check(line);
            own = std::make_shared<OwnCheck>(OwnCheck{std::move(line), std::move(planned)});
        }
        plan.own = own;
        words.resize(first);
        for (const std::string& word : check)
            words.push_back(sequence::has_names(word)
                                ? sequence::file_names(word, options, {item}).front()
                                : word);
    }
    if (has_store()) {
        const auto found = approved().find(item.name);
        if (found != approved().end()) {
            plan.images = found->second.images;
            plan.problem = found->second.problem;
        }
    }
    return plan;
}

Strings SuitePlan::attributing(const Strings& words) const {
    Strings asking = words;
    for (const Word& word : chain::parse_line(words).words)
        if (measures(word) && has_modifier(word, "attribute") && m_suite.attribute)
            asking[word.at] = word.token.with_modifier("attribute", "1");
    return asking == words ? Strings() : asking;
}

std::shared_ptr<SuitePlan> suite_of(const chain::ParsedLine& line) {
    const Word* found = nullptr;
    for (const Word& word : line.words) {
        if (!word.is("suite"))
            continue;
        if (found)
            throw CommandError("--suite is given twice");
        if (word.arguments.empty() || line.texts[word.arguments.front()].empty())
            throw CommandError("--suite: FILE is missing (valid: --suite suite.toml)");
        found = &word;
    }
    return found ? std::make_shared<SuitePlan>(line, *found) : nullptr;
}

} // namespace tonetool::runs
