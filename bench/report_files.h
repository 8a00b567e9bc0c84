// What any report needs: its folder, its files, and on what machine, of what and when it was made.
#pragma once

#include <functional>
#include <string>

namespace lks_bench {

std::string machine_name(); // processor, threads and compiler
std::string run_name();     // solver version and today's date

// Before anything is measured, which takes minutes: whether a report can be written there. Complains if it
// can't, or will have no plots.
bool prepare_report(const std::string& folder, const std::function<void(const std::string&)>& complain);
// False, with a sentence: it can't be, or nothing can be written there.
bool make_folder(const std::string& folder, std::string& error);
bool write_file(const std::string& folder, const std::string& name, const std::string& text,
                std::string& error);

} // namespace lks_bench
