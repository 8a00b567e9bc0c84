// A plot as a script of gnuplot's, and its drawing.
#pragma once

#include <string>
#include <vector>

namespace lks_bench {

// One plot's commands and data, with the looks that all share.
class Script {
public:
    explicit Script(const std::string& title, int width = 1280, int height = 600);

    void command(const std::string& line) { text_ += line + "\n"; }
    // A block of data; its name.
    std::string data(const std::string& lines);
    const std::string& text() const { return text_; }

private:
    std::string text_;
    int blocks_ = 0;
};

std::string value_pair(double x, double y); // a line of data
std::string comma_separated(const std::vector<std::string>& parts);

// False, with a sentence.
bool has_gnuplot(std::string& error);
// Into FOLDER/FILE, an SVG.
bool draw(const std::string& folder, const std::string& file, const Script& script, std::string& error);

} // namespace lks_bench
