#include "support/options.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <sstream>

namespace graben {
namespace {

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string> splitWords(const std::string& text) {
  std::vector<std::string> words;
  std::size_t i = 0;
  while ((i = text.find_first_not_of(" \t", i)) != std::string::npos) {
    const bool quoted = text[i] == '"';
    const std::size_t begin = quoted ? i + 1 : i;
    const std::size_t end =
        std::min(quoted ? text.find('"', begin) : text.find_first_of(" \t", begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    i = end + (quoted && end < text.size() ? 1 : 0);
  }
  return words;
}

std::string unquoted(const std::string& text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

bool isLongOption(const std::string& word) {
  return word.rfind("--", 0) == 0;
}

/// A word such as -x; a lone dash or a negative number is none.
bool isShortOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word[1] != '-' && word[1] != '.' &&
         (word[1] < '0' || word[1] > '9');
}

/// Appends text to out in lines of at most 100 columns, all but the first indented.
void appendWrapped(std::string& out, const std::string& text, std::size_t indent,
                   std::size_t column) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > 100) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      out += " ";
      ++column;
    }
    out += word;
    column += word.size();
  }
  out += "\n";
}

} // namespace

OptionParser::OptionParser(std::string tool, std::string summary)
    : tool_(std::move(tool))
    , summary_(std::move(summary)) {
  current_section_ = "General";
  value("config", "FILE", "read options from 'key = value' lines; the command line wins");
  flag("help", "show this text");
  flag("version", "show the version");
  current_section_ = "Options";
}

OptionParser& OptionParser::section(const std::string& title) {
  current_section_ = title;
  return *this;
}

OptionParser& OptionParser::declare(Option option) {
  for (const Option& other : options_)
    if (other.name == option.name)
      throw std::logic_error("option --" + option.name + " is declared twice");
  option.section = current_section_;
  options_.push_back(std::move(option));
  return *this;
}

OptionParser& OptionParser::flag(const std::string& name, const std::string& help) {
  return declare({name, "", help, "", "", Kind::Flag});
}

OptionParser& OptionParser::value(const std::string& name, const std::string& placeholder,
                                  const std::string& help, const std::string& default_value) {
  return declare({name, placeholder, help, default_value, "", Kind::Value});
}

OptionParser& OptionParser::list(const std::string& name, const std::string& placeholder,
                                 const std::string& help) {
  return declare({name, placeholder, help, "", "", Kind::List});
}

OptionParser& OptionParser::positionals(const std::string& placeholder, const std::string& help,
                                        std::size_t least, std::size_t most) {
  positional_placeholder_ = placeholder;
  positional_help_ = help;
  least_positionals_ = least;
  most_positionals_ = most;
  return *this;
}

OptionParser& OptionParser::epilog(const std::string& text) {
  epilog_ = text;
  return *this;
}

const OptionParser::Option& OptionParser::find(const std::string& name,
                                               const std::string& where) const {
  constexpr std::size_t longest_word = 100; // longer ones are like none
  const Option* nearest = nullptr;
  std::size_t nearest_distance = 0;
  for (const Option& option : options_) {
    if (option.name == name)
      return option;
    const bool prefix = !name.empty() && option.name.rfind(name, 0) == 0;
    const std::size_t distance = prefix ? 1 : editDistance(option.name, name.substr(0, longest_word));
    if (!nearest || distance < nearest_distance) {
      nearest = &option;
      nearest_distance = distance;
    }
  }
  std::string message = where + "unknown option --" + name;
  if (nearest_distance <= std::max<std::size_t>(2, name.size() / 3))
    message += "; did you mean --" + nearest->name + "?";
  throw UsageError(message);
}

void OptionParser::take(const Option& option, const std::vector<std::string>& values,
                        OptionValues& into, const std::string& where) const {
  OptionValues::Entry& entry = into.entries_[option.name];
  if (option.kind == Kind::Value && entry.given)
    throw UsageError(where + "option --" + option.name + " is given twice");
  if (!entry.given)
    entry.values.clear();
  entry.given = true;
  entry.values.insert(entry.values.end(), values.begin(), values.end());
  entry.where.insert(entry.where.end(), values.size(), where);
  for (const std::string& value : values)
    if (value.empty())
      throw UsageError(where + "option --" + option.name + " has an empty value");
}

OptionValues OptionParser::parseArguments(const std::vector<std::string>& arguments) const {
  OptionValues given;
  bool options_ended = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string word = arguments[i] == "-h" && !options_ended ? "--help" : arguments[i];
    if (options_ended || !(isLongOption(word) || isShortOption(word))) {
      given.positionals_.push_back(word);
      continue;
    }
    if (word == "--") {
      options_ended = true;
      continue;
    }
    if (!isLongOption(word))
      throw UsageError("unknown option " + word + "; options start with two dashes");
    const std::size_t equals = word.find('=');
    const Option& option =
        find(word.substr(2, equals == std::string::npos ? equals : equals - 2), "");
    std::vector<std::string> values;
    if (equals != std::string::npos)
      values.push_back(word.substr(equals + 1));
    else if (option.kind != Kind::Flag)
      while (i + 1 < arguments.size() && !isLongOption(arguments[i + 1]) &&
             (values.empty() || option.kind == Kind::List))
        values.push_back(arguments[++i]);
    if (option.kind == Kind::Flag && !values.empty())
      throw UsageError("option --" + option.name + " takes no value");
    if (option.kind != Kind::Flag && values.empty())
      throw UsageError("option --" + option.name + " needs a value (" + option.placeholder + ")");
    take(option, values, given, "");
  }
  return given;
}

void OptionParser::readConfig(const std::string& file, OptionValues& into) const {
  std::ifstream in(file);
  if (!in)
    throw IoError(file, "cannot open the configuration file");
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (number == 1 && (line.rfind("\xFF\xFE", 0) == 0 || line.rfind("\xFE\xFF", 0) == 0))
      throw UsageError(file + ": is in UTF-16; save it as UTF-8 or plain text");
    if (number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0)
      line.erase(0, 3); // byte order mark
    line = trimmed(line);
    if (line.empty() || line[0] == '#')
      continue;
    const std::string where = file + ":" + std::to_string(number) + ": ";
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos)
      throw UsageError(where + "expected 'key = value'");
    const Option& option = find(trimmed(line.substr(0, equals)), where);
    const std::string value = trimmed(line.substr(equals + 1));
    if (option.name == "config" || option.name == "help" || option.name == "version")
      throw UsageError(where + "--" + option.name + " belongs on the command line");
    if (value.empty())
      throw UsageError(where + "'" + option.name + "' has no value");
    if (option.kind == Kind::Flag) {
      const bool yes = value == "yes" || value == "true";
      if (!yes && value != "no" && value != "false")
        throw UsageError(where + "'" + option.name + "' takes yes or no, not '" + value + "'");
      if (yes)
        take(option, {}, into, where);
    } else {
      take(option,
           option.kind == Kind::List ? splitWords(value)
                                     : std::vector<std::string>{unquoted(value)},
           into, where);
    }
  }
  if (in.bad())
    throw IoError(file, "cannot read the configuration file");
}

OptionValues OptionParser::parse(const std::vector<std::string>& arguments) const {
  OptionValues values;
  for (const std::string& word : arguments) {
    if (word == "--")
      break;
    if (word == "--help" || word == "-h" || word == "--version")
      values.entries_[word == "--version" ? "version" : "help"].given = true;
  }
  const bool information_only = !values.entries_.empty();
  if (!information_only) {
    values = parseArguments(arguments);
    const auto config = values.entries_.find("config");
    if (config != values.entries_.end()) {
      OptionValues from_file;
      readConfig(config->second.values.front(), from_file);
      values.entries_.insert(from_file.entries_.begin(), from_file.entries_.end());
    }
    const std::size_t count = values.positionals_.size();
    if (count > most_positionals_)
      throw UsageError("'" + values.positionals_[most_positionals_] + "' belongs to no option");
    if (count < least_positionals_)
      throw UsageError("missing " + positional_placeholder_);
  }
  for (const Option& option : options_) {
    OptionValues::Entry& entry = values.entries_[option.name];
    if (!entry.given && !option.default_value.empty())
      entry.values = {option.default_value};
  }
  return values;
}

std::string OptionParser::versionText() const {
  return tool_ + " " + GRABEN_VERSION + "\n";
}

std::string OptionParser::helpText() const {
  constexpr std::size_t kColumn = 30;
  std::string out = "Usage: " + tool_ + " [options]";
  if (most_positionals_ > 0)
    out += " " + positional_placeholder_ + (most_positionals_ > 1 ? " ..." : "");
  out += "\n";
  appendWrapped(out, summary_, 0, 0);
  if (most_positionals_ > 0) {
    out += "\n  " + positional_placeholder_ + "  ";
    appendWrapped(out, positional_help_, positional_placeholder_.size() + 4,
                  positional_placeholder_.size() + 4);
  }
  std::vector<std::string> sections;
  for (const Option& option : options_)
    if (option.section != "General" &&
        std::find(sections.begin(), sections.end(), option.section) == sections.end())
      sections.push_back(option.section);
  sections.push_back("General");
  for (const std::string& section : sections) {
    out += "\n" + section + ":\n";
    for (const Option& option : options_) {
      if (option.section != section)
        continue;
      std::string left = "  --" + option.name;
      if (option.kind != Kind::Flag)
        left += " " + option.placeholder + (option.kind == Kind::List ? " ..." : "");
      left += left.size() + 2 > kColumn ? "\n" + std::string(kColumn, ' ')
                                        : std::string(kColumn - left.size(), ' ');
      out += left;
      const std::string preset =
          option.default_value.empty() ? "" : " (default " + option.default_value + ")";
      appendWrapped(out, option.help + preset, kColumn, kColumn);
    }
  }
  out += "\nExit codes: 0 done; 1 the input cannot be used, or a check asked for is not met; 2 wrong use; 4 an output\n"
         "cannot be written; 5 a mistake in graben; 130 Ctrl-C.\n";
  return epilog_.empty() ? out : out + "\n" + epilog_ + "\n";
}

} // namespace graben
