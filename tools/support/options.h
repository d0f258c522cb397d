#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace graben {

/// Wrong use of a command line: unknown option, missing or bad value. runTool turns it into exit
/// code 2.
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// What was given on the command line and in the configuration file, read by option name (without
/// dashes).
///
/// Reading a name that was not declared is a mistake in the tool and throws std::logic_error.
class OptionValues {
public:
  /// True if the option was given; defaults do not count.
  bool has(const std::string& name) const;

  /// The value given, or the declared default; empty if there is neither. For a list: its first
  /// value.
  const std::string& text(const std::string& name) const;

  /// All values of an option in the order given.
  const std::vector<std::string>& texts(const std::string& name) const;

  /// The value as a finite number in [low, high]; 0 if there is neither value nor default.
  /// \throw UsageError naming the option, if the value is anything else
  double number(const std::string& name, double low = -std::numeric_limits<double>::max(),
                double high = std::numeric_limits<double>::max()) const;

  /// The value as a whole number in [low, high]; "2e6" is one too.
  long long integer(const std::string& name, long long low = std::numeric_limits<long long>::min(),
                    long long high = std::numeric_limits<long long>::max()) const;

  /// Numbers separated by commas, exactly \a count of them (0: any number), as in --origin X,Y,Z.
  std::vector<double> numbers(const std::string& name, std::size_t count = 0) const;

  /// The same for each value of a repeated option.
  std::vector<std::vector<double>> numberLists(const std::string& name,
                                               std::size_t count = 0) const;

  /// The index of the value among \a allowed. \throw UsageError listing them if it is none of them
  std::size_t choice(const std::string& name, const std::vector<std::string>& allowed) const;

  /// Refuses a value of an option: where it stands in a configuration file, the option, the value and why.
  /// \param[in] which place in texts(name)
  /// \throw UsageError always
  [[noreturn]] void refuse(const std::string& name, const std::string& why, std::size_t which = 0) const;

  const std::vector<std::string>& positionals() const { return positionals_; }

private:
  friend class OptionParser;
  struct Entry {
    std::vector<std::string> values; ///< given, or else the default
    std::vector<std::string> where;  ///< of each value given: "file:line: ", empty on the command line
    bool given = false;
  };
  const Entry& entry(const std::string& name) const;
  double numberIn(const std::string& name, const std::string& text, std::size_t which) const;
  std::vector<double> numbersIn(const std::string& name, std::size_t which, std::size_t count) const;

  std::map<std::string, Entry> entries_;
  std::vector<std::string> positionals_;
};

/// A strict parser for the graben commands: long options only, each declared with its help text.
///
/// "--name value" and "--name=value" are the same. A list option takes one value or more, up to the
/// next word that starts with two dashes, and may be repeated, so that --fault A --fault B and
/// --fault A B do the same. An option that is no list may be given once. "--" ends the options.
/// Every parser knows --help, --version and --config FILE; a configuration file has "key = value"
/// lines with the same names, "#" comments, yes/no or true/false for flags, and blanks between a
/// list's values ("..." holds blanks). Options on the command line replace those of the file.
class OptionParser {
public:
  /// \param[in] tool    the command's name
  /// \param[in] summary what it does, one or two sentences
  OptionParser(std::string tool, std::string summary);

  /// Starts a titled group of options in the help text.
  OptionParser& section(const std::string& title);

  /// An option without value.
  OptionParser& flag(const std::string& name, const std::string& help);

  /// An option with one value.
  /// \param[in] placeholder what the help shows for the value, for example "FILE"
  /// \param[in] default_value what text() and number() return if it is not given; shown in the help
  OptionParser& value(const std::string& name, const std::string& placeholder,
                      const std::string& help, const std::string& default_value = "");

  /// An option with one value or more that may be repeated.
  OptionParser& list(const std::string& name, const std::string& placeholder,
                     const std::string& help);

  /// Allows between \a least and \a most words that belong to no option.
  OptionParser& positionals(const std::string& placeholder, const std::string& help,
                            std::size_t least, std::size_t most);

  /// Text after the options in the help, for examples.
  OptionParser& epilog(const std::string& text);

  /// \throw UsageError on wrong use. With --help or --version nothing else is checked.
  /// \throw IoError if the configuration file cannot be read
  OptionValues parse(const std::vector<std::string>& arguments) const;

  const std::string& tool() const { return tool_; }
  std::string helpText() const;
  std::string versionText() const;

private:
  enum class Kind { Flag, Value, List };
  struct Option {
    std::string name, placeholder, help, default_value, section;
    Kind kind = Kind::Flag;
  };
  OptionParser& declare(Option option);
  const Option& find(const std::string& name, const std::string& where) const;
  void take(const Option& option, const std::vector<std::string>& values, OptionValues& into,
            const std::string& where) const;
  OptionValues parseArguments(const std::vector<std::string>& arguments) const;
  void readConfig(const std::string& file, OptionValues& into) const;

  std::string tool_, summary_, epilog_, current_section_ = "Options";
  std::vector<Option> options_;
  std::string positional_placeholder_, positional_help_;
  std::size_t least_positionals_ = 0, most_positionals_ = 0;
};

} // namespace graben
