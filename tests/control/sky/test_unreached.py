"""What is shaded on the page is what an order does not get: the two are compared direction by direction."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.mount import Mount, Range, Sector, Unreachable
from rotator.control.sky.pointing_model import PointingModel
from rotator.control.sky.unreached import HIGH_DEG, WIDE_DEG, WITHIN_DEG, unreached

CHIMNEY = Sector("chimney", Range(100, 120), Range(0, 30), 2.0)
AZIMUTHS = st.sampled_from([Range(0, 360), Range(0, 450), Range(-180, 180), Range(0, 350), Range(20, 200)])
MOUNTS = st.builds(
    Mount,
    AZIMUTHS,
    st.sampled_from([Range(0, 180), Range(0, 90), Range(0, 80), Range(5, 175), Range(0, 120)]),
    flip=st.booleans(),
    horizon=st.sampled_from([(), ((10.0, 4.0), (100.0, 22.0), (300.0, 2.0))]),
    sectors=st.sampled_from([(), (CHIMNEY,)]),
    model=st.sampled_from([PointingModel(), PointingModel(ia_deg=3.0, ie_deg=-1.0)]),
)


def gets_there(mount: Mount, azimuth_deg: float, elevation_deg: float) -> bool:
    """As an order is obeyed, on each turn that it may name, and over the top where the antenna may."""
    bare = Mount(mount.azimuth, mount.elevation, flip=mount.flip, sectors=mount.sectors, model=mount.model)
    for near_deg in (mount.azimuth.min_deg, mount.azimuth.max_deg):
        for over in (False, True) if mount.flip else (False,):
            try:
                azimuth, elevation = bare.axis_angles(azimuth_deg, elevation_deg, near_deg, over=over)
            except Unreachable:
                continue
            assert elevation is not None
            off_deg = bare.off_deg(bare.pointed(azimuth, elevation), (azimuth_deg, elevation_deg))
            if off_deg <= WITHIN_DEG and bare.inside_deg(azimuth, elevation) <= 0:
                return True
    return False


@given(mount=MOUNTS, azimuth_deg=st.floats(0, 359.9), elevation_deg=st.floats(0, 89.0))
def test_shaded_is_what_an_order_does_not_get(mount: Mount, azimuth_deg: float, elevation_deg: float) -> None:
    shaded = any(
        west <= azimuth_deg < east and low <= elevation_deg < high for west, east, low, high in unreached(mount)
    )
    # Near an edge the two may differ by what an edge is drawn with.
    nearby = {
        gets_there(mount, (azimuth_deg + az) % 360.0, min(max(elevation_deg + el, 0.0), 90.0))
        for az in (-WIDE_DEG, 0.0, WIDE_DEG)
        for el in (-HIGH_DEG, 0.0, HIGH_DEG)
    }
    assert len(nearby) == 2 or shaded is not nearby.pop()
