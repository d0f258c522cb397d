"""Results of many realizations taken in one by one, in memory that does not grow with their number."""

from typing import Tuple

import numpy as np


class Moments:
    """Mean and standard deviation of values at places, and how many there were; NaN is no value. The order of adding counts in the last bits."""

    def __init__(self, shape: Tuple[int, ...]):
        self.count = np.zeros(shape, np.int64)
        self._mean = np.zeros(shape)
        self._squares = np.zeros(shape)

    def add(self, values: np.ndarray) -> None:
        known = np.isfinite(values)
        self.count += known
        step = np.where(known, values - self._mean, 0.0)
        self._mean += step / np.maximum(self.count, 1)
        self._squares += step * np.where(known, values - self._mean, 0.0)

    @property
    def mean(self) -> np.ndarray:
        return np.where(self.count > 0, self._mean, np.nan)

    @property
    def deviation(self) -> np.ndarray:
        return np.where(self.count > 1, np.sqrt(self._squares / np.maximum(self.count - 1, 1)), np.nan)


class Quantiles:
    """Quantiles of values at places. The first values are kept as they are; beyond KEPT of them they are counted in bins.

    Exact up to KEPT values; then within the width of a bin, a thousandth of the range of the first ones doubled, which doubles where a value lies outside.
    """

    KEPT = 128
    BINS = 1024

    def __init__(self, places: int):
        self._places = places
        self._first = np.full((self.KEPT, places), np.nan)
        self._seen = 0
        self._bins = np.zeros((0, 0), np.uint32)

    def add(self, values: np.ndarray) -> None:
        if self._seen < self.KEPT:
            self._first[self._seen] = values
            self._seen += 1
            return
        if self._seen == self.KEPT:
            self._make_bins()
            for former in self._first:
                self._put(former)
        self._seen += 1
        self._put(values)

    def _make_bins(self) -> None:
        known = np.isfinite(self._first)
        low = np.min(np.where(known, self._first, np.inf), axis=0)
        high = np.max(np.where(known, self._first, -np.inf), axis=0)
        some = known.any(axis=0)
        low, high = np.where(some, low, 0.0), np.where(some, high, 1.0)
        middle = 0.5 * (low + high)
        half = np.maximum(high - low, 1e-9 * np.maximum(np.abs(middle), 1.0))
        self._low, self._width = middle - half, 2.0 * half / self.BINS
        self._bins = np.zeros((self._places, self.BINS), np.uint32)
        self._fresh = ~some

    def _put(self, values: np.ndarray) -> None:
        known = np.isfinite(values)
        born = self._fresh & known  # a place that had no value before
        self._low[born] = values[born] - np.maximum(np.abs(values[born]), 1.0)
        self._width[born] = 2.0 * np.maximum(np.abs(values[born]), 1.0) / self.BINS
        self._fresh &= ~known
        while True:
            place = np.floor((np.where(known, values, self._low) - self._low) / self._width)
            out = (place < 0) | (place >= self.BINS)
            if not out.any():
                break
            self._double(np.flatnonzero(out), place < 0)
        rows = np.flatnonzero(known)
        self._bins[rows, place[rows].astype(int)] += 1

    def _double(self, rows: np.ndarray, below: np.ndarray) -> None:
        """Bins of double width: the former range becomes the upper or the lower half."""
        for row in rows:
            pairs = self._bins[row].reshape(-1, 2).sum(axis=1)
            half = self.BINS // 2
            self._bins[row] = 0
            if below[row]:
                self._low[row] -= self.BINS * self._width[row]
                self._bins[row, half:] = pairs
            else:
                self._bins[row, :half] = pairs
            self._width[row] *= 2.0

    def at(self, share: float) -> np.ndarray:
        """The value that this share of the values at each place does not exceed; NaN where there are none."""
        if self._seen <= self.KEPT:
            kept = self._first[: self._seen]
            result = np.full(self._places, np.nan)
            some = np.isfinite(kept).any(axis=0) if len(kept) else np.zeros(self._places, bool)
            if some.any():
                result[some] = np.nanquantile(kept[:, some], share, axis=0)
            return result
        total = self._bins.sum(axis=1, dtype=np.int64)
        rank = share * np.maximum(total - 1, 0)
        lower = np.floor(rank).astype(np.int64)
        a, b = self._ranked(lower), self._ranked(np.minimum(lower + 1, np.maximum(total - 1, 0)))
        return np.where(total > 0, a + (rank - lower) * (b - a), np.nan)

    def _ranked(self, rank: np.ndarray) -> np.ndarray:
        """The value of a rank from 0 at each place: the values of a bin are spread evenly over it."""
        counts = np.cumsum(self._bins, axis=1, dtype=np.int64)
        found = np.minimum((counts <= rank[:, None]).sum(axis=1), self.BINS - 1)
        rows = np.arange(self._places)
        there = np.maximum(self._bins[rows, found], 1)
        return self._low + (found + (rank - (counts[rows, found] - self._bins[rows, found]) + 0.5) / there) * self._width
