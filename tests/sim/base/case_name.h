// Names of cases as GoogleTest takes them: of letters, digits and underscores.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <type_traits>

#include "sim/base/enum_names.h"

namespace hysteron::test {

// Returns "tr_bdf2" of "tr-bdf2".
inline std::string case_name(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// Names a case that is a text, has a name, or is of an enumeration that has names.
struct CaseName {
  template <class Case>
  std::string operator()(const ::testing::TestParamInfo<Case>& info) const {
    if constexpr (std::is_convertible_v<Case, std::string>)
      return case_name(info.param);
    else if constexpr (requires { info.param.name(); })
      return case_name(info.param.name());
    else if constexpr (requires { info.param.name; })
      return case_name(info.param.name);
    else
      return case_name(enum_name(info.param));
  }
};

}  // namespace hysteron::test
