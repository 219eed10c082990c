// SPDX-License-Identifier: BSD-3-Clause
// --suite: the command line that a suite file stands for, and what its rows say of each case.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chain/language/line.h"
#include "runs/check_plan.h"
#include "sequence/frames/file_sequence.h"
#include "sequence/suite/suite_file.h"
#include "store/store.h"

namespace tonetool::runs {

/// A check that some cases of a suite have in place of that of the suite.
struct OwnCheck {
    chain::ParsedLine line;
    CheckPlan check;
};

/// What the suite says of one case.
struct SuiteCasePlan {
    std::string skip;                           ///< why it is not looked at; empty: it is
    std::string problem{};                      ///< why it cannot be checked
    int line = 0;                               ///< of the row that set its limits
    std::string why{};                          ///< of its rows
    std::shared_ptr<const OwnCheck> own{};      ///< nullptr: the suite's
    std::vector<store::ApprovedImage> images{}; ///< that it may equal, of a store
};

class SuitePlan {
public:
    /// Of the file that `line` names. A CommandError where the file or what stands beside it on
    /// the line is wrong.
    SuitePlan(const chain::ParsedLine& line, const chain::Word& word);

    /// The line with the suite's images and check behind its own words.
    const chain::ParsedLine& line() const { return m_line; }
    /// The words of `check` in results begin so.
    Strings title() const;
    const sequence::Suite& suite() const { return m_suite; }
    sequence::SuiteOrigin origin() const;

    /// The place of the reference's word; that of the test is the next one.
    size_t reference_at() const { return m_reference_at; }
    bool has_store() const { return !m_store_folder.empty(); }
    store::Store store() const { return store::Store(m_store_folder); }
    const std::string& key() const { return m_key; }
    /// The approved images that --key asks for, as the files of the reference.
    sequence::Files approved_files();

    /// The line that checks that case alone, for messages.
    std::string case_line(const sequence::Item& item) const;

    /// Throws a CommandError where a row matches none of the cases.
    void check_rows(const std::vector<sequence::Item>& cases);
    /// What is said of a case. `files`: the words of its run, which are replaced where it has a
    /// check of its own.
    SuiteCasePlan plan_case(const sequence::Item& item, Strings& words,
                            const sequence::PatternOptions& options);

    /// The words of a case that failed, with attribute=1; empty where the suite does not ask for
    /// it, or no command of the check has it.
    Strings attributing(const Strings& words) const;

private:
    Strings words_of(const sequence::SuiteSettings& settings) const;
    chain::ParsedLine line_with(const Strings& check) const;
    Strings check_words(const std::string& text, const std::string& where) const;
    void set_limits(chain::ParsedLine& check, const std::string& key,
                    const sequence::SuiteSetting& setting) const;
    void set_modifier(chain::ParsedLine& check, const std::string& key,
                      const sequence::SuiteSetting& setting) const;
    std::string place(int line) const;
    void refuse_store_among_tests() const;
    // What the store has for a case: the images of the key, or why they are not known.
    struct Approved {
        std::vector<store::ApprovedImage> images;
        std::string problem;
    };
    const std::map<std::string, Approved>& approved();

    sequence::Suite m_suite;
    std::string m_text, m_sha256, m_store_folder, m_key;
    Strings m_given; ///< the words of the command line
    chain::ParsedLine m_line;
    size_t m_reference_at = 0;
    std::map<Strings, std::shared_ptr<const OwnCheck>> m_own;
    std::optional<std::map<std::string, Approved>> m_approved; ///< read once
};

/// The suite of a line, or nullptr.
std::shared_ptr<SuitePlan> suite_of(const chain::ParsedLine& line);

} // namespace tonetool::runs
