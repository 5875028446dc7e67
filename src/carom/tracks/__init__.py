"""Tracks of filmed balls: read from what tracking programs write, cut at contacts, measured into rebounds."""

from __future__ import annotations

from carom.tracks.track import Track

__all__ = ["Track"]
