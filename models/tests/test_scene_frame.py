"""The packed frame says a scene without loss; its faults are the loader's, in their order."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.limits import Fault
from models.scene.frame import Capacity, CounterWidths, Frame, FrameError, check, pack, unpack
from models.scene.strategies import cameras, scenes, undrawable_cameras
from models.scene.types import Camera, Light, Material, Scene, Sphere, Triangle

GREY = Material((1, 2, 3), (4, 5, 6), (7, 8, 9), (10, 11, 12), (13, 14, 15), 4)
PLAIN = Scene(
    camera=Camera((0, 0, -1024), (0, 1024, 0), (0, 0, 0)),
    lights=(Light((-1, 0, 1), (1024, 1024, 1024)),),
    spheres=(Sphere(GREY, (-262144, 0, 262143), 31),),
    triangles=(Triangle(GREY, ((0, 0, 0), (1, 0, 0), (0, 1, 0))),),
    ambient=(0, 0, 524287),
    background=(1, 1, 1),
)
CAMERA_BITS, COUNTER_BITS, LIGHT_BITS, SPHERE_BITS = 171, 8, 114, 352
RADIUS_BIT = CAMERA_BITS + COUNTER_BITS + LIGHT_BITS + SPHERE_BITS - 5


def bits_of(frame: Frame) -> str:
    return "".join(format(word, "032b") for word in frame.words)


def frame_of(bits: str) -> Frame:
    padded = bits + "0" * (-len(bits) % 32)
    return Frame(tuple(int(padded[at : at + 32], 2) for at in range(0, len(padded), 32)))


def with_bits(frame: Frame, at: int, value: str) -> Frame:
    bits = bits_of(frame)
    return frame_of(bits[:at] + value + bits[at + len(value) :])


@settings(max_examples=60, deadline=None)
@given(scenes())
def test_a_scene_survives_packing_and_unpacking(scene: Scene) -> None:
    frame = pack(scene)
    assert unpack(frame) == scene
    assert pack(unpack(frame)) == frame
    assert check(frame.words) is Fault.NONE


@settings(max_examples=30, deadline=None)
@given(scenes(Capacity(6, 9, 20)))
def test_wider_counters_hold_larger_scenes(scene: Scene) -> None:
    counters = CounterWidths(3, 4, 5)
    assert unpack(pack(scene, counters), counters) == scene


@settings(max_examples=30, deadline=None)
@given(scenes())
def test_bytes_and_hex_say_the_same_words(scene: Scene) -> None:
    frame = pack(scene)
    assert Frame.from_bytes(frame.to_bytes()) == frame
    assert Frame.from_hex(frame.to_hex("one line\nand another")) == frame


def test_fields_stand_where_the_book_puts_them() -> None:
    bits = bits_of(pack(PLAIN))
    fields = CAMERA_BITS + COUNTER_BITS + LIGHT_BITS + SPHERE_BITS + 461 + 114
    assert len(bits) == -(-fields // 32) * 32
    assert bits[38:57] == format(2**19 - 1024, "019b"), "z of the camera's position"
    assert bits[CAMERA_BITS : CAMERA_BITS + COUNTER_BITS] == "01" + "01" + "0001"
    light = CAMERA_BITS + COUNTER_BITS
    assert bits[light : light + 19] == "1" * 19, "x = -1 of the light"
    sphere = light + LIGHT_BITS
    assert bits[sphere] == "0"
    assert bits[sphere + 286 : sphere + 290] == "0100", "index"
    assert bits[sphere + 290 : sphere + 309] == "1" + "0" * 18, "x of the center"
    assert bits[RADIUS_BIT : RADIUS_BIT + 6] == "11111" + "1", "radius, then the triangle's kind"
    assert bits[fields - 114 : fields - 57] == "0" * 38 + "1" * 19, "ambient light"
    assert set(bits[fields:]) <= {"0"}, "padding"


def test_padding_is_ignored() -> None:
    frame = pack(PLAIN)
    assert unpack(with_bits(frame, len(bits_of(frame)) - 1, "1")) == PLAIN


def test_every_shorter_frame_is_short() -> None:
    words = pack(PLAIN).words
    for length in range(len(words)):
        assert check(words[:length]) is Fault.FRAME_SHORT


def test_a_whole_extra_word_is_long() -> None:
    assert check((*pack(PLAIN).words, 0)) is Fault.FRAME_LONG


def test_the_word_that_ends_with_the_last_bit_ends_the_frame() -> None:
    scene = replace(PLAIN, lights=(), spheres=(), triangles=())
    for light_bits in range(1, 40):
        counters = CounterWidths(light_bits, 2, 4)
        words = pack(scene, counters).words
        assert len(words) == -(-(CAMERA_BITS + light_bits + 6 + 114) // 32)
        assert check(words, counters) is Fault.NONE
        assert check(words[:-1], counters) is Fault.FRAME_SHORT
        assert check((*words, 0), counters) is Fault.FRAME_LONG


@pytest.mark.parametrize(
    ("capacity", "field"),
    [
        (Capacity(0, 3, 15), "number of lights"),
        (Capacity(3, 0, 15), "number of spheres"),
        (Capacity(3, 3, 0), "number of triangles"),
        (Capacity(3, 0, 0), "number of spheres"),
    ],
)
def test_a_count_above_the_capacity_is_refused(capacity: Capacity, field: str) -> None:
    frame = pack(PLAIN)
    assert check(frame.words, capacity=capacity) is Fault.CAPACITY
    with pytest.raises(FrameError) as refused:
        unpack(frame, capacity=capacity)
    assert refused.value.field == field
    assert check(frame.words[:6], capacity=capacity) is Fault.CAPACITY, "known before the frame ends"


def test_a_wrong_kind_bit_is_refused_where_it_is_read() -> None:
    sphere = CAMERA_BITS + COUNTER_BITS + LIGHT_BITS
    frame = with_bits(pack(PLAIN), sphere, "1")
    assert check(frame.words) is Fault.KIND
    assert check(frame.words[: sphere // 32 + 1]) is Fault.KIND
    assert check(frame.words[: sphere // 32]) is Fault.FRAME_SHORT
    assert check(with_bits(pack(PLAIN), sphere + SPHERE_BITS, "0").words) is Fault.KIND


def test_radius_zero_is_refused_where_it_is_read() -> None:
    frame = pack(replace(PLAIN, spheres=(replace(PLAIN.spheres[0], radius=0),)))
    assert check(frame.words) is Fault.RADIUS
    end_of_radius = -(-(RADIUS_BIT + 5) // 32)
    assert check(frame.words[:end_of_radius]) is Fault.RADIUS
    assert check(frame.words[: end_of_radius - 1]) is Fault.FRAME_SHORT
    assert check(with_bits(frame, RADIUS_BIT + 5, "0").words) is Fault.RADIUS, "before the triangle's kind"


@given(undrawable_cameras())
def test_a_camera_without_a_picture_is_the_last_fault(camera: Camera) -> None:
    frame = pack(replace(PLAIN, camera=camera))
    same = camera.center == camera.position
    assert check(frame.words) is (Fault.CAMERA_POSITION if same else Fault.CAMERA_UP)
    assert check((*frame.words, 0)) is Fault.FRAME_LONG
    assert check(with_bits(frame, RADIUS_BIT, "00000").words) is Fault.RADIUS


def test_the_camera_check_is_exact() -> None:
    almost = Camera((-262144,) * 3, (262143, 262143, 262142), (262143,) * 3)
    assert check(pack(replace(PLAIN, camera=almost)).words) is Fault.NONE
    parallel = replace(almost, up=(262143,) * 3)
    assert check(pack(replace(PLAIN, camera=parallel)).words) is Fault.CAMERA_UP


@given(cameras())
def test_drawn_cameras_are_accepted(camera: Camera) -> None:
    assert check(pack(replace(PLAIN, camera=camera)).words) is Fault.NONE


@settings(deadline=None)
@given(st.lists(st.integers(0, 2**32 - 1), max_size=80))
def test_check_agrees_with_unpack_on_any_words(words: list[int]) -> None:
    fault = check(words)
    try:
        unpack(Frame(tuple(words)))
    except FrameError as error:
        assert error.fault is fault
        assert error.fault.name in str(error) and error.field in str(error)
    else:
        assert fault is Fault.NONE


def test_more_objects_than_the_counter_says_cannot_be_packed() -> None:
    with pytest.raises(ValueError, match=r"scene.lights: 4 are more than the 3"):
        pack(replace(PLAIN, lights=PLAIN.lights * 4))


@pytest.mark.parametrize("text", ["xyz", "123456789", "@0000", "_", "-1"])
def test_hex_that_is_no_word_is_refused_with_its_line(text: str) -> None:
    with pytest.raises(ValueError, match=r"line 2: .* is not a word"):
        Frame.from_hex(f"// comment\n{text}\n")


def test_hex_reads_as_readmemh_does() -> None:
    assert Frame.from_hex("dead_BEEF 1 // two\n\n// none\n2") == Frame((0xDEADBEEF, 1, 2))


def test_bytes_are_whole_words() -> None:
    with pytest.raises(ValueError, match="3 bytes are not whole"):
        Frame.from_bytes(b"abc")


@pytest.mark.parametrize("word", [-1, 2**32])
def test_words_have_32_bits(word: int) -> None:
    with pytest.raises(ValueError, match="word 1"):
        Frame((0, word))


def test_counters_have_bits() -> None:
    with pytest.raises(ValueError, match="at least one bit"):
        CounterWidths(lights=0)
