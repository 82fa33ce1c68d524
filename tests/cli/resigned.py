"""Archives and checkpoints that were changed and whose digests are right nevertheless."""
import ctypes
import pathlib
import resource

MEMORY = 2 << 30  # bytes of addresses that a reader of a bad file gets
USER_BLOCK, BLOCK, MARK, DIGEST = 4096, 8 << 20, 16, 16


class Hash(ctypes.Structure):
    _fields_ = [("low", ctypes.c_uint64), ("high", ctypes.c_uint64)]


library = ctypes.CDLL("libxxhash.so.0")
library.XXH3_128bits.argtypes = [ctypes.c_char_p, ctypes.c_size_t]
library.XXH3_128bits.restype = Hash


def xxh3_128(data):
    value = library.XXH3_128bits(data, len(data))
    return value.high.to_bytes(8, "big") + value.low.to_bytes(8, "big")


def sign_archive(path):
    """Writes length and digest of what an archive holds now into its header."""
    path = pathlib.Path(path)
    data = path.read_bytes()
    contents = data[USER_BLOCK:]
    digest = xxh3_128(b"".join(xxh3_128(contents[at:at + BLOCK]) for at in range(0, len(contents), BLOCK)))
    lines = data[:USER_BLOCK].decode().split("\n")
    lines[2] = f"bytes after the first 4096: {len(contents)}"
    lines[3] = f"xxh3-128 tree digest of them: {digest.hex()}"
    header = "\n".join(lines).rstrip("\0").encode()
    path.write_bytes(header.ljust(USER_BLOCK, b"\0") + contents)


def state_of(checkpoint):
    return checkpoint[MARK:-DIGEST]


def sign_checkpoint(mark, state):
    return mark[:MARK] + state + xxh3_128(state)


def limit_memory():
    """For subprocess: a reader that believes a bad file's sizes does not get what it asks for."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
