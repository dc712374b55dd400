#include "tools/loop/vocabulary_file.h"

#include <stdexcept>

#include "tools/evaluation/text_file.h"

// The file's bytes, into the program as they are. (The labels are global, for arm64's linker
// forgets how far into its section a local one is.)
__asm__(
    ".section .rodata\n"
    ".globl sparsight_vocabulary_begin, sparsight_vocabulary_end\n"
    ".hidden sparsight_vocabulary_begin, sparsight_vocabulary_end\n"
    ".balign 16\n"
    "sparsight_vocabulary_begin:\n"
    ".incbin \"" SPARSIGHT_VOCABULARY
    "\"\n"
    "sparsight_vocabulary_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" const char sparsight_vocabulary_begin;  // NOLINT(readability-identifier-naming)
extern "C" const char sparsight_vocabulary_end;    // NOLINT(readability-identifier-naming)

namespace sparsight {

std::shared_ptr<const Vocabulary> built_in_vocabulary() {
  static const std::shared_ptr<const Vocabulary> kVocabulary = [] {
    const std::string_view bytes(&sparsight_vocabulary_begin,
                                 &sparsight_vocabulary_end - &sparsight_vocabulary_begin);
    auto vocabulary = Vocabulary::from_bytes(bytes, "config/vocabulary.bin");
    // A test loads it, so that only a broken build comes here.
    if (!vocabulary) throw std::runtime_error(vocabulary.error().message);
    return std::make_shared<const Vocabulary>(std::move(*vocabulary));
  }();
  return kVocabulary;
}

Result<Vocabulary> parse_vocabulary(std::string_view bytes, const std::string& source) {
  return bytes.starts_with("SPVOC") ? Vocabulary::from_bytes(bytes, source)
                                    : Vocabulary::from_text(bytes, source);
}

Result<Vocabulary> load_vocabulary(const std::string& file) {
  return read_text_file(file).and_then(
      [&](const std::string& bytes) { return parse_vocabulary(bytes, file); });
}

}  // namespace sparsight
