// Calls a function for every member of a plain struct, so that none can be left out.
#pragma once

#include <cstddef>
#include <type_traits>

namespace ncvet {

/// How many members the aggregate `T` has: one for each `{}` that it may be made of. Too few of
/// them (a member that `{}` cannot make) do not fit the names in `eachField` and do not compile.
template <typename T>
constexpr size_t fieldCount() {
  static_assert(std::is_aggregate_v<T>);
  if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 13;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 12;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 11;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 10;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 9;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}}; })
    return 8;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}}; })
    return 7;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}}; })
    return 6;
  else if constexpr (requires { T{{}, {}, {}, {}, {}}; })
    return 5;
  else if constexpr (requires { T{{}, {}, {}, {}}; })
    return 4;
  else if constexpr (requires { T{{}, {}, {}}; })
    return 3;
  else if constexpr (requires { T{{}, {}}; })
    return 2;
  else
    return 1;
}

/// Calls `visit` with each member of `value`, in their order.
template <typename T, typename Visit>
void eachField(T &value, const Visit &visit) {
  constexpr size_t count = fieldCount<std::remove_const_t<T>>();
  const auto all = [&](auto &...fields) { (visit(fields), ...); };
  static_assert(count < 13, "a struct of so many members is better made of smaller ones");
  if constexpr (count == 1) {
    auto &[a] = value;
    all(a);
  } else if constexpr (count == 2) {
    auto &[a, b] = value;
    all(a, b);
  } else if constexpr (count == 3) {
    auto &[a, b, c] = value;
    all(a, b, c);
  } else if constexpr (count == 4) {
    auto &[a, b, c, d] = value;
    all(a, b, c, d);
  } else if constexpr (count == 5) {
    auto &[a, b, c, d, e] = value;
    all(a, b, c, d, e);
  } else if constexpr (count == 6) {
    auto &[a, b, c, d, e, f] = value;
    all(a, b, c, d, e, f);
  } else if constexpr (count == 7) {
    auto &[a, b, c, d, e, f, g] = value;
    all(a, b, c, d, e, f, g);
  } else if constexpr (count == 8) {
    auto &[a, b, c, d, e, f, g, h] = value;
    all(a, b, c, d, e, f, g, h);
  } else if constexpr (count == 9) {
    auto &[a, b, c, d, e, f, g, h, i] = value;
    all(a, b, c, d, e, f, g, h, i);
  } else if constexpr (count == 10) {
    auto &[a, b, c, d, e, f, g, h, i, j] = value;
    all(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (count == 11) {
    auto &[a, b, c, d, e, f, g, h, i, j, k] = value;
    all(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (count == 12) {
    auto &[a, b, c, d, e, f, g, h, i, j, k, l] = value;
    all(a, b, c, d, e, f, g, h, i, j, k, l);
  }
}

} // namespace ncvet
