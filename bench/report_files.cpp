#include "report_files.h"

#include <lockstitch/lockstitch.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

#include "gnuplot.h"

namespace lks_bench {
namespace {

namespace fs = std::filesystem;

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) == 0 && line.find(':') != std::string::npos) {
            return line.substr(line.find(':') + 2);
        }
    }
    return "unknown processor";
}

std::string compiler_name() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "g++ " __VERSION__;
#else
    return "unknown compiler";
#endif
}

} // namespace

std::string machine_name() {
    return processor_name() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads; " +
           compiler_name();
}

std::string run_name() {
    const std::time_t now = std::time(nullptr);
    char date[20] = "";
    std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
    return "solver version " + std::to_string(lks_solver_version()) + "; " + date + " UTC";
}

bool prepare_report(const std::string& folder, const std::function<void(const std::string&)>& complain) {
    std::string error;
    if (!make_folder(folder, error)) {
        complain(error);
        return false;
    }
    if (!has_gnuplot(error)) {
        complain("The plots need the program gnuplot, which is not here; the report will be without them.");
    }
    return true;
}

bool make_folder(const std::string& folder, std::string& error) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (!failure && !fs::is_directory(folder, failure)) {
        failure = std::make_error_code(std::errc::not_a_directory);
    }
    if (failure) {
        error = "The folder " + folder + " can't be made: " + failure.message() + ".";
        return false;
    }
    const std::string probe = "can-be-written";
    if (!write_file(folder, probe, "", error)) {
        error = "Nothing can be written to the folder " + folder + ".";
        return false;
    }
    fs::remove(fs::path(folder) / probe, failure);
    return true;
}

bool write_file(const std::string& folder, const std::string& name, const std::string& text,
                std::string& error) {
    const fs::path path = fs::path(folder) / name;
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
        error = "The file " + path.string() + " can't be written.";
    }
    return static_cast<bool>(file);
}

} // namespace lks_bench
