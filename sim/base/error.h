// The one exception type: every failure is a single line for the user and an exit code for scripts.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace hysteron {

// Thrown wherever the program cannot do what was asked.  The message is one line, whatever the file or flag
// that it quotes holds: what was attempted, the value with its unit, the file and line where it stands, what
// is allowed or what to do.  Fields beside the message hold what a handler has to know, so that nobody parses
// the message.
class Error : public std::runtime_error {
 public:
  // Makes an error of the machine (file, disk, GPU, renderer): exit code 1.
  static Error system(const std::string& message) { return Error(1, message); }
  // Makes an error of the request (unknown key, wrong type, out of range, impossible mesh): exit code 2.
  static Error invalid_input(const std::string& message) { return Error(2, message); }
  // Makes an error of a run that cannot go on (no convergence, no feasible state): exit code 3.
  static Error simulation(const std::string& message) { return Error(3, message); }

  // Returns the error with a key and the value that it was given: "fabric.b2", "-1".
  Error with_key(std::string key, std::string value) const {
    Error error = *this;
    error.key_ = std::move(key);
    error.value_ = std::move(value);
    return error;
  }
  // Returns the error with the name of the experiment, which then begins its message: "law: k.csv:3: ...".
  Error with_experiment(const std::string& experiment) const {
    Error error = with_message(experiment + ": " + what());
    error.experiment_ = experiment;
    return error;
  }
  // Returns the error with its place behind the message: "... (scene.toml:7)".
  Error with_origin(const std::string& origin) const {
    return with_message(std::string(what()) + " (" + origin + ")");
  }

  int exit_code() const { return exit_code_; }
  const std::string& key() const { return key_; }                // "" if no key is to blame
  const std::string& value() const { return value_; }            // text without its unit
  const std::string& experiment() const { return experiment_; }  // "" if its message names none

 private:
  Error(int exit_code, const std::string& message)
      : std::runtime_error(one_line(message)), exit_code_(exit_code) {}
  static std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, ' ');
    return text.substr(0, text.find_last_not_of(' ') + 1);
  }
  Error with_message(const std::string& message) const {
    Error error(exit_code_, message);
    error.key_ = key_;
    error.value_ = value_;
    error.experiment_ = experiment_;
    return error;
  }

  int exit_code_;
  std::string key_, value_, experiment_;
};

}  // namespace hysteron
