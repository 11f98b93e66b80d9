//! Encoding of numbers, texts, options and lists.

use std::ffi::OsString;
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::path::PathBuf;
use std::time::Duration;

use super::{Malformed, Reader, Wire};

macro_rules! numbers {
    ($($type:ty, $expected:literal;)*) => {$(
        impl Wire for $type {
            fn write(&self, into: &mut Vec<u8>) {
                into.extend(self.to_le_bytes());
            }
            fn read(from: &mut Reader<'_>) -> Result<$type, Malformed> {
                Ok(<$type>::from_le_bytes(from.array($expected)?))
            }
        }
    )*};
}

numbers! {
    u8, "a byte";
    u32, "a number of 4 bytes";
    i32, "a number of 4 bytes";
    u64, "a number of 8 bytes";
    i64, "a number of 8 bytes";
    f64, "a number of 8 bytes";
}

impl Wire for bool {
    fn write(&self, into: &mut Vec<u8>) {
        u8::from(*self).write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<bool, Malformed> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(from.malformed("0 or 1")),
        }
    }
}

impl Wire for String {
    fn write(&self, into: &mut Vec<u8>) {
        write_count(self.len(), into);
        into.extend(self.as_bytes());
    }

    fn read(from: &mut Reader<'_>) -> Result<String, Malformed> {
        let count = from.count()?;
        let bytes = from.take(count, "the text")?;
        std::str::from_utf8(bytes)
            .map(str::to_owned)
            .map_err(|_| from.malformed("UTF-8"))
    }
}

impl Wire for PathBuf {
    fn write(&self, into: &mut Vec<u8>) {
        let bytes = self.as_os_str().as_bytes();
        write_count(bytes.len(), into);
        into.extend(bytes);
    }

    fn read(from: &mut Reader<'_>) -> Result<PathBuf, Malformed> {
        let count = from.count()?;
        let bytes = from.take(count, "the path")?;
        Ok(PathBuf::from(OsString::from_vec(bytes.to_vec())))
    }
}

impl<T: Wire> Wire for Option<T> {
    fn write(&self, into: &mut Vec<u8>) {
        self.is_some().write(into);
        if let Some(value) = self {
            value.write(into);
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Option<T>, Malformed> {
        bool::read(from)?.then(|| T::read(from)).transpose()
    }
}

impl<T: Wire> Wire for Vec<T> {
    fn write(&self, into: &mut Vec<u8>) {
        write_count(self.len(), into);
        for item in self {
            item.write(into);
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<Vec<T>, Malformed> {
        let count = from.count()?;
        // The list grows as items are read, so a false count allocates no memory.
        let mut items = Vec::new();
        for _ in 0..count {
            items.push(T::read(from)?);
        }
        Ok(items)
    }
}

impl<A: Wire, B: Wire> Wire for (A, B) {
    fn write(&self, into: &mut Vec<u8>) {
        self.0.write(into);
        self.1.write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<(A, B), Malformed> {
        Ok((A::read(from)?, B::read(from)?))
    }
}

impl Wire for Duration {
    fn write(&self, into: &mut Vec<u8>) {
        u64::try_from(self.as_nanos())
            .unwrap_or(u64::MAX)
            .write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Duration, Malformed> {
        Ok(Duration::from_nanos(u64::read(from)?))
    }
}

pub(super) fn write_count(count: usize, into: &mut Vec<u8>) {
    // A count above 2³² belongs to a message that is too long to send.
    u32::try_from(count).unwrap_or(u32::MAX).write(into);
}
