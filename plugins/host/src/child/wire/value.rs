//! Encoding of the values of `taceva_core`. Numbers are encoded by their bits, so that the transfer changes no value.

use taceva_core::{
    ArgValue, Axes, Axis, Deadline, Degree, DriverKind, ErrorKind, Fault, FrameInfo, GratingKind,
    Guard, GuardedStop, Hertz, Millimetre, Nanometre, Newton, NewtonMillimetre, PixelFormat, Point,
    Pose, Rotation, Specimen, Speed, Stamp, Wrench,
};

use super::{Malformed, Reader, Wire, fields, variants};
use crate::library::Level;

macro_rules! quantities {
    ($($type:ident),*) => {$(
        impl Wire for $type {
            fn write(&self, into: &mut Vec<u8>) {
                self.0.write(into);
            }
            fn read(from: &mut Reader<'_>) -> Result<$type, Malformed> {
                Ok($type(Wire::read(from)?))
            }
        }
    )*};
}

quantities!(
    Millimetre,
    Newton,
    NewtonMillimetre,
    Degree,
    Hertz,
    Nanometre
);

fields!(Point { x, y, z });
fields!(Rotation { x, y, z });
fields!(Pose { position, rotation });
fields!(Wrench { force, torque });
fields!(Stamp {
    valid_s,
    received_s
});
fields!(FrameInfo {
    width,
    height,
    format
});
impl Wire for Guard {
    fn write(&self, into: &mut Vec<u8>) {
        self.force.write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Guard, Malformed> {
        Ok(Guard::at(Wire::read(from)?))
    }
}

variants!(GuardedStop, "the end of a guarded motion" {
    0 => Arrived { stamp },
    1 => Guarded { pose, stamp },
});

variants!(Specimen, "a specimen" {
    0 => Sphere { radius },
    1 => Grating { kind, spacing },
});

impl<T: Wire> Wire for [T; 3] {
    fn write(&self, into: &mut Vec<u8>) {
        for item in self {
            item.write(into);
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<[T; 3], Malformed> {
        Ok([T::read(from)?, T::read(from)?, T::read(from)?])
    }
}

impl Wire for Deadline {
    fn write(&self, into: &mut Vec<u8>) {
        self.remaining().write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Deadline, Malformed> {
        Ok(Deadline::after(Wire::read(from)?))
    }
}

impl Wire for Speed {
    fn write(&self, into: &mut Vec<u8>) {
        self.mm_per_s().write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Speed, Malformed> {
        Speed::try_new(f64::read(from)?).map_err(|_| from.malformed("a speed above 0"))
    }
}

impl Wire for Axes {
    fn write(&self, into: &mut Vec<u8>) {
        for axis in Axis::ALL {
            self.contains(axis).write(into);
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Axes, Malformed> {
        let mut axes = Axes::NONE;
        for axis in Axis::ALL {
            if bool::read(from)? {
                axes = axes.with(axis);
            }
        }
        Ok(axes)
    }
}

impl Wire for ErrorKind {
    fn write(&self, into: &mut Vec<u8>) {
        (*self as i32).write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<ErrorKind, Malformed> {
        let number = i32::read(from)?;
        ErrorKind::ALL
            .into_iter()
            .find(|kind| *kind as i32 == number)
            .ok_or_else(|| from.malformed("a kind of error"))
    }
}

impl Wire for Fault {
    fn write(&self, into: &mut Vec<u8>) {
        let number = Fault::ALL.iter().position(|fault| fault == self);
        // An unlisted fault is written as the last one of the list, a controller fault.
        let number = number.unwrap_or(Fault::ALL.len() - 1);
        u32::try_from(number).unwrap_or(u32::MAX).write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Fault, Malformed> {
        let number = usize::try_from(u32::read(from)?).ok();
        let fault = number.and_then(|number| Fault::ALL.get(number));
        fault.copied().ok_or_else(|| from.malformed("a fault"))
    }
}

impl Wire for ArgValue {
    fn write(&self, into: &mut Vec<u8>) {
        match self {
            ArgValue::Text(text) => (0_u8, text.clone()).write(into),
            ArgValue::Whole(whole) => (1_u8, *whole).write(into),
            ArgValue::Number(number) => (2_u8, *number).write(into),
            ArgValue::Flag(flag) => (3_u8, *flag).write(into),
            // An unknown kind gets a tag that every reader rejects.
            _ => u8::MAX.write(into),
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<ArgValue, Malformed> {
        match u8::read(from)? {
            0 => Ok(ArgValue::Text(Wire::read(from)?)),
            1 => Ok(ArgValue::Whole(Wire::read(from)?)),
            2 => Ok(ArgValue::Number(Wire::read(from)?)),
            3 => Ok(ArgValue::Flag(Wire::read(from)?)),
            _ => Err(from.malformed("the value of an argument")),
        }
    }
}

/// Implements [`Wire`] for a type whose values are in `$list`: the encoding is the index. A value outside the list gets the index after the last one.
macro_rules! listed {
    ($($type:ty, $list:expr, $expected:literal;)*) => {$(
        impl Wire for $type {
            fn write(&self, into: &mut Vec<u8>) {
                let place = $list.iter().position(|listed| listed == self);
                super::basic::write_count(place.unwrap_or($list.len()), into);
            }
            fn read(from: &mut Reader<'_>) -> Result<$type, Malformed> {
                let place = usize::try_from(u32::read(from)?).ok();
                place
                    .and_then(|place| $list.into_iter().nth(place))
                    .ok_or_else(|| from.malformed($expected))
            }
        }
    )*};
}
pub(super) use listed;

listed! {
    PixelFormat, [PixelFormat::Gray8, PixelFormat::Gray16, PixelFormat::Rgb8, PixelFormat::Rgb16], "a pixel format";
    DriverKind, DriverKind::ALL, "a kind of device";
    GratingKind, GratingKind::ALL, "a kind of grating";
    Level, [Level::Error, Level::Warn, Level::Info, Level::Debug], "a log level";
}
