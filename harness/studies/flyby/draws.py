"""Normally distributed draws that are functions of seed, number and run alone, the same as in Monte Carlo runs of `heliotorque plan`.

Method: ChaCha with 8 rounds (Bernstein 2008), its key expanded from the seed by PCG32, its stream the draw's, Box and Muller.
"""

import numpy as np

# Channel of dispersions among the streams.
DISPERSION = 17
CONSTANTS = np.frombuffer(b"expand 32-byte k", dtype=np.uint32)
QUARTERS = (
    (0, 4, 8, 12),
    (1, 5, 9, 13),
    (2, 6, 10, 14),
    (3, 7, 11, 15),
    (0, 5, 10, 15),
    (1, 6, 11, 12),
    (2, 7, 8, 13),
    (3, 4, 9, 14),
)


def key(seed):
    """The eight words that PCG32 makes of a seed."""
    words, state, mask = [], seed, 2**64 - 1
    for _ in range(8):
        state = (state * 6_364_136_223_846_793_005 + 11_634_580_027_462_260_723) & mask
        shifted, turn = (((state >> 18) ^ state) >> 27) & 0xFFFF_FFFF, state >> 59
        words.append(((shifted >> turn) | (shifted << (-turn & 31))) & 0xFFFF_FFFF)
    return np.array(words, dtype=np.uint32)


def block(seed, streams):
    """The first sixteen words of streams, one row a stream."""
    words = np.zeros((16, len(streams)), dtype=np.uint32)
    words[:4], words[4:12] = CONSTANTS[:, None], key(seed)[:, None]
    words[14], words[15] = streams & 0xFFFF_FFFF, streams >> np.uint64(32)
    first = words.copy()
    for _ in range(4):
        for a, b, c, d in QUARTERS:
            for to, by, with_, turn in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
                words[to] += words[by]
                mixed = words[with_] ^ words[to]
                words[with_] = (mixed << np.uint32(turn)) | (mixed >> np.uint32(32 - turn))
    return (words + first).T


def normal_vectors(seed, number, runs):
    """Three numbers of mean 0 and variance 1 for each of so many runs, one row a run."""
    streams = np.uint64(DISPERSION << 56) ^ np.uint64(number << 40) ^ np.arange(runs, dtype=np.uint64)
    words = block(seed, streams).astype(np.uint64)
    bits = words[:, 0::2] | (words[:, 1::2] << np.uint64(32))
    uniform = ((bits >> np.uint64(11)) + 0.5) / 2.0**53
    radius, angle_rad = np.sqrt(-2.0 * np.log(uniform[:, 0:4:2])), 2.0 * np.pi * uniform[:, 1:4:2]
    both = radius * np.cos(angle_rad)
    return np.column_stack([both[:, 0], radius[:, 0] * np.sin(angle_rad[:, 0]), both[:, 1]])
