//! Arguments. The host checks them against the manifest.

use crate::text::Text;

/// `taceva_arg`: one argument. The host writes a number both as text and as a number; a driver may read either.
///
/// ```
/// use taceva_abi::{Arg, Text};
/// let seed = Arg { key: Text::from("seed"), text: Text::from("7"), whole: 7, number: 0.0, kind: Arg::WHOLE, reserved: 0 };
/// assert_eq!(seed.whole, 7);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Arg {
    /// Name of the argument.
    pub key: Text,
    /// Value as text, for every type.
    pub text: Text,
    /// Value of an integer argument; 0 or 1 for a flag.
    pub whole: i64,
    /// Value of a real-number argument, in the unit that the manifest declares.
    pub number: f64,
    /// [`Arg::TEXT`], [`Arg::WHOLE`], [`Arg::NUMBER`] or [`Arg::FLAG`].
    pub kind: u32,
    /// Reserved, 0.
    pub reserved: u32,
}

impl Arg {
    /// A text, a path or a choice.
    pub const TEXT: u32 = 1;
    /// A whole number.
    pub const WHOLE: u32 = 2;
    /// A number.
    pub const NUMBER: u32 = 3;
    /// A flag: on or off.
    pub const FLAG: u32 = 4;
}

/// `taceva_args`: all arguments.
///
/// ```
/// use taceva_abi::{Arg, Args, Text};
/// let items = [Arg { key: Text::from("fast"), text: Text::from("true"), whole: 1, number: 0.0, kind: Arg::FLAG, reserved: 0 }];
/// let args = Args { items: items.as_ptr(), count: items.len() };
/// // SAFETY: `items` lives and has `count` elements.
/// let read = unsafe { std::slice::from_raw_parts(args.items, args.count) };
/// assert_eq!(read[0].kind, Arg::FLAG);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Args {
    /// First argument; NULL only if `count` is 0.
    pub items: *const Arg,
    /// Number of arguments.
    pub count: usize,
}
