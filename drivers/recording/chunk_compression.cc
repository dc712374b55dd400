#include "drivers/recording/chunk_compression.h"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace sparsight {
namespace {

// At 1, zstd is still several times slower than lz4; below, it gains nothing over it.
constexpr int kZstdLevel = 1;
constexpr std::size_t kStep = 1 << 20;  // by how much the output grows

struct DecoderEnd {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

// One step of a streaming decoder: how far it came, and whether the data ended or are damaged.
struct Progress {
  std::size_t read = 0;
  std::size_t written = 0;
  bool ended = false;
  bool damaged = false;
};

// The output grows with what really comes out, so that a promise of terabytes costs nothing.
template <typename Decode>
bool decode_within(std::uint64_t limit, Bytes bytes, std::vector<std::uint8_t>& out,
                   Decode decode) {
  std::size_t written = 0;
  for (;;) {
    out.resize(written + std::min<std::uint64_t>(kStep, limit - written + 1));
    const Progress progress = decode(bytes, out.data() + written, out.size() - written);
    written += progress.written;
    bytes = bytes.subspan(progress.read);
    const bool stuck = progress.read == 0 && progress.written == 0;
    if (!progress.ended && !progress.damaged && !stuck && written <= limit) continue;
    const bool whole = progress.ended && bytes.empty() && written <= limit;
    out.resize(std::min<std::uint64_t>(written, limit));
    return whole;
  }
}

bool decompress_lz4(Bytes bytes, std::uint64_t limit, std::vector<std::uint8_t>& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0U) return false;
  const std::unique_ptr<LZ4F_dctx, DecoderEnd> context(made);
  return decode_within(limit, bytes, out, [&](Bytes in, std::uint8_t* to, std::size_t room) {
    std::size_t read = in.size();
    const std::size_t hint = LZ4F_decompress(context.get(), to, &room, in.data(), &read, nullptr);
    if (LZ4F_isError(hint) != 0U) return Progress{.damaged = true};
    return Progress{read, room, hint == 0, false};
  });
}

bool decompress_zstd(Bytes bytes, std::uint64_t limit, std::vector<std::uint8_t>& out) {
  const std::unique_ptr<ZSTD_DCtx, DecoderEnd> context(ZSTD_createDCtx());
  if (!context) return false;
  return decode_within(limit, bytes, out, [&](Bytes in, std::uint8_t* to, std::size_t room) {
    ZSTD_inBuffer input{in.data(), in.size(), 0};
    ZSTD_outBuffer output{to, room, 0};
    const std::size_t hint = ZSTD_decompressStream(context.get(), &output, &input);
    return Progress{input.pos, output.pos, hint == 0, ZSTD_isError(hint) != 0U};
  });
}

}  // namespace

std::string_view mcap_name(Compression compression) {
  switch (compression) {
    case Compression::kLz4:
      return "lz4";
    case Compression::kZstd:
      return "zstd";
    case Compression::kNone:
      break;
  }
  return "";
}

std::optional<Compression> compression_of(std::string_view name) {
  for (const Compression each : {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    if (name == mcap_name(each)) return each;
  }
  return std::nullopt;
}

void compress(Compression compression, Bytes bytes, std::vector<std::uint8_t>& out) {
  if (compression == Compression::kLz4) {
    LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
    preferences.frameInfo.contentSize = bytes.size();
    preferences.frameInfo.blockSizeID = LZ4F_max256KB;
    out.resize(LZ4F_compressFrameBound(bytes.size(), &preferences));
    out.resize(
        LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), &preferences));
  } else if (compression == Compression::kZstd) {
    out.resize(ZSTD_compressBound(bytes.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kZstdLevel));
  } else {
    out.assign(bytes.begin(), bytes.end());
  }
}

bool decompress(Compression compression, Bytes bytes, std::uint64_t limit,
                std::vector<std::uint8_t>& out) {
  if (compression == Compression::kLz4) return decompress_lz4(bytes, limit, out);
  if (compression == Compression::kZstd) return decompress_zstd(bytes, limit, out);
  out.assign(bytes.begin(), bytes.begin() + std::min<std::uint64_t>(bytes.size(), limit));
  return bytes.size() <= limit;
}

}  // namespace sparsight
