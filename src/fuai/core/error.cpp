// Composes the text of an Error.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/core/error.h"

#include <utility>

namespace fuai {
namespace {

std::string compose(const std::string& what, const Where& where, const std::string& cure) {
  std::string text = to_string(where) + what;
  if (!cure.empty()) text += "; " + cure;
  return text;
}

}  // namespace

std::string to_string(const Where& where) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  if (!text.empty()) text += ": ";
  if (!where.key.empty()) text += where.key + ": ";
  return text;
}

Error::Error(ErrorKind kind, const std::string& what, Where where, std::string cure)
    : std::runtime_error(compose(what, where, cure)),
      kind_(kind),
      problem_(what),
      where_(std::move(where)),
      cure_(std::move(cure)) {}

}  // namespace fuai
