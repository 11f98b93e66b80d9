//! Draft extension, which may change: controls a rig that is a simulated bench.

use core::ffi::c_void;

use crate::device::Rig;
use crate::error::Error;
use crate::status::Status;
use crate::text::{TakeText, Text};

/// Id of this ability.
pub const BENCH: &str = "taceva.rig.bench/draft-1";

/// `taceva_specimen`: the object that a robot carries.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::Specimen;
/// let ball = Specimen { size: size_of::<Specimen>() as u32, kind: Specimen::SPHERE, size_nm: 4_000_000 }; // 4 mm radius
/// assert_ne!(ball.kind, Specimen::LINE);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Specimen {
    /// Size of this struct, bytes.
    pub size: u32,
    /// [`Specimen::SPHERE`], [`Specimen::LINE`] or [`Specimen::DOT`].
    pub kind: u32,
    /// Radius of a sphere or spacing of a grating, nm.
    pub size_nm: i64,
}

impl Specimen {
    /// A sphere.
    pub const SPHERE: u32 = 1;
    /// A grating of lines.
    pub const LINE: u32 = 2;
    /// A grating of dots.
    pub const DOT: u32 = 3;
}

/// `taceva_bench_calls`. `bench` is the value of `rig=` with which the devices were opened.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::BenchCalls;
/// let calls = BenchCalls {
///     size: size_of::<BenchCalls>() as u32,
///     reserved: 0,
///     now_ns: None,
///     rest: None,
///     mount: None,
///     name_press: None,
///     schedule: None,
///     provenance: None,
/// };
/// assert!(calls.now_ns.is_none(), "a host takes a table without a clock for no bench");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct BenchCalls {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[any]` Returns the time of the bench's clock, ns.
    pub now_ns: Option<unsafe extern "C" fn(*mut Rig, bench: Text) -> u64>,
    /// `[any]` Advances the bench's clock by `rest_ns`.
    pub rest:
        Option<unsafe extern "C" fn(*mut Rig, bench: Text, rest_ns: u64, *mut Error) -> Status>,
    /// `[any]` Mounts a specimen. Fails while the tip touches the gel.
    pub mount:
        Option<unsafe extern "C" fn(*mut Rig, bench: Text, *const Specimen, *mut Error) -> Status>,
    /// `[any]` Sets the name of the next press. The name alone determines the random numbers of the press.
    pub name_press:
        Option<unsafe extern "C" fn(*mut Rig, bench: Text, name: u64, *mut Error) -> Status>,
    /// `[any]` Delays the next tare until `at_ns`.
    pub schedule:
        Option<unsafe extern "C" fn(*mut Rig, bench: Text, at_ns: u64, *mut Error) -> Status>,
    /// `[any]` Writes the provenance of the simulated data.
    pub provenance: Option<
        unsafe extern "C" fn(*mut Rig, bench: Text, TakeText, *mut c_void, *mut Error) -> Status,
    >,
}
