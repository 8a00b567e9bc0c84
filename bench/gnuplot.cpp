#include "gnuplot.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace lks_bench {

namespace fs = std::filesystem;

Script::Script(const std::string& title, int width, int height)
    : text_("set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
            " font 'sans,15' background '#ffffff'\nset title \"" + title +
            "\"\nset grid lc '#dddddd'\nset key outside right\n") {}

std::string Script::data(const std::string& lines) {
    const std::string name = "$d" + std::to_string(blocks_++);
    text_ += name + " << EOD\n" + lines + "EOD\n";
    return name;
}

std::string value_pair(double x, double y) {
    char text[80];
    std::snprintf(text, sizeof text, "%.9g %.9g\n", x, y);
    return text;
}

std::string comma_separated(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) {
        text += (text.empty() ? "" : ", ") + part;
    }
    return text;
}

bool has_gnuplot(std::string& error) {
#if defined(_WIN32)
    const char* const probe = "gnuplot --version > NUL 2>&1";
#else
    const char* const probe = "gnuplot --version > /dev/null 2>&1";
#endif
    if (std::system(probe) != 0) {
        error = "The plots need the program gnuplot; the tables were written without them.";
        return false;
    }
    return true;
}

bool draw(const std::string& folder, const std::string& file, const Script& script, std::string& error) {
    const fs::path path = fs::path(folder) / (file + ".gnuplot");
    std::ofstream stream(path);
    stream << "set output '" << (fs::path(folder) / file).string() << "'\n" << script.text();
    stream.close();
    if (!stream) {
        error = "The file " + path.string() + " can't be written.";
        return false;
    }
    if (std::system(("gnuplot '" + path.string() + "'").c_str()) != 0) {
        error = "gnuplot did not draw " + path.string() + ".";
        return false;
    }
    fs::remove(path);
    return true;
}

} // namespace lks_bench
