//! Checks pointers from the host before memory is read or written.

#![expect(unsafe_code, reason = "pointers of the host are followed")]

use std::ffi::c_void;

use taceva_abi::{TakeText, Text};

use crate::failure::Failure;

/// Returns the object at `pointer` for reading. Rejects NULL and misaligned addresses.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to a `T` that stays unchanged during `'a`.
pub(crate) unsafe fn given<'a, T>(name: &str, pointer: *const T) -> Result<&'a T, Failure> {
    straight(name, pointer)?;
    // SAFETY: guaranteed by the caller; NULL and misaligned addresses were rejected.
    Ok(unsafe { &*pointer })
}

/// Returns the object at `pointer` for writing. Rejects NULL and misaligned addresses.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to a `T` that no other code uses during `'a`.
pub(crate) unsafe fn place<'a, T>(name: &str, pointer: *mut T) -> Result<&'a mut T, Failure> {
    straight(name, pointer)?;
    // SAFETY: guaranteed by the caller; NULL and misaligned addresses were rejected.
    Ok(unsafe { &mut *pointer })
}

/// Returns a struct for reading whose first field, a `u32`, is its size in bytes. Rejects a struct shorter than `T`.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to as many bytes as its first `u32` states. The bytes stay unchanged during `'a`.
pub(crate) unsafe fn sized<'a, T>(name: &str, pointer: *const T) -> Result<&'a T, Failure> {
    straight(name, pointer)?;
    // SAFETY: guaranteed by the caller.
    let size = unsafe { pointer.cast::<u32>().read() };
    long_enough::<T>(name, size)?;
    // SAFETY: as above, and the struct is at least as long as a `T`.
    Ok(unsafe { &*pointer })
}

/// Same as [`sized`], for writing.
///
/// # Safety
/// As [`sized`], and no other code uses the bytes during `'a`.
pub(crate) unsafe fn sized_place<'a, T>(name: &str, pointer: *mut T) -> Result<&'a mut T, Failure> {
    straight(name, pointer)?;
    // SAFETY: guaranteed by the caller.
    let size = unsafe { pointer.cast::<u32>().read() };
    long_enough::<T>(name, size)?;
    // SAFETY: as above, and the struct is at least as long as a `T`.
    Ok(unsafe { &mut *pointer })
}

fn straight<T>(name: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(format!("`{name}` is NULL")));
    }
    if !pointer.is_aligned() {
        return Err(Failure::argument(format!("`{name}` is not aligned")));
    }
    Ok(())
}

fn long_enough<T>(name: &str, size: u32) -> Result<(), Failure> {
    let expected = size_of::<T>();
    if usize::try_from(size).unwrap_or(usize::MAX) < expected {
        return Err(Failure {
            status: taceva_abi::Status::ABI,
            message: format!("`{name}` has {size} bytes, expected at least {expected}"),
            fault: taceva_abi::FaultNumber::NONE,
        });
    }
    Ok(())
}

/// Returns a list of `length` objects that begins at `first`, for reading.
///
/// # Safety
/// `first` is NULL, misaligned, or the start of `length` objects that stay unchanged during `'a`.
pub(crate) unsafe fn list<'a, T>(
    name: &str,
    first: *const T,
    length: usize,
) -> Result<&'a [T], Failure> {
    if length == 0 {
        return Ok(&[]);
    }
    fits::<T>(name, length)?;
    straight(name, first)?;
    // SAFETY: guaranteed by the caller; the length fits an allocation.
    Ok(unsafe { std::slice::from_raw_parts(first, length) })
}

/// Same as [`list`], for writing.
///
/// # Safety
/// As [`list`], and no other code uses the objects during `'a`.
pub(crate) unsafe fn list_place<'a, T>(
    name: &str,
    first: *mut T,
    length: usize,
) -> Result<&'a mut [T], Failure> {
    if length == 0 {
        return Ok(&mut []);
    }
    fits::<T>(name, length)?;
    straight(name, first)?;
    // SAFETY: guaranteed by the caller; the length fits an allocation.
    Ok(unsafe { std::slice::from_raw_parts_mut(first, length) })
}

fn fits<T>(name: &str, length: usize) -> Result<(), Failure> {
    let bytes = length.checked_mul(size_of::<T>());
    match bytes.filter(|bytes| isize::try_from(*bytes).is_ok()) {
        Some(_) => Ok(()),
        None => Err(Failure::argument(format!(
            "`{name}`: {length} objects exceed the address space"
        ))),
    }
}

/// Returns a text of the host after a check of its address and of UTF-8.
///
/// # Safety
/// `text.data` is NULL, or its `text.length` bytes stay unchanged during `'a`.
pub(crate) unsafe fn text<'a>(name: &str, text: Text) -> Result<&'a str, Failure> {
    if text.data.is_null() && text.length > 0 {
        return Err(Failure::argument(format!("`{name}` is NULL")));
    }
    fits::<u8>(name, text.length)?;
    // SAFETY: guaranteed by the caller.
    unsafe { text.to_str() }.map_err(|error| Failure::argument(format!("`{name}`: {error}")))
}

/// Passes `text` to the callback `take` of the host.
///
/// # Safety
/// `take` may be called with `context` and any text.
pub(crate) unsafe fn hand(take: TakeText, context: *mut c_void, text: &str) -> Result<(), Failure> {
    let take = take.ok_or_else(|| Failure::argument("`take` is NULL"))?;
    // SAFETY: guaranteed by the caller.
    unsafe { take(context, Text::from(text)) };
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pointers_that_cannot_be_meant_are_refused_unfollowed() {
        let crooked = std::ptr::without_provenance::<u64>(9);
        let null = std::ptr::null::<u64>();
        // SAFETY: no pointer is dereferenced.
        let found = unsafe { [given("x", null), given("x", crooked), sized("x", crooked)] };
        assert!(found.iter().all(Result::is_err));
        // SAFETY: no pointer is dereferenced.
        let lists = unsafe {
            [
                list("x", null, 1),
                list("x", crooked, 1),
                list("x", null, usize::MAX),
            ]
        };
        assert!(lists.iter().all(Result::is_err));
        // SAFETY: the list is empty, so the pointer is not dereferenced.
        assert!(unsafe { list("x", null, 0) }.expect("nothing").is_empty());
    }

    #[test]
    fn text_is_refused_where_it_is_none() {
        let latin = [0xe9_u8];
        let text_of = |data: *const u8, length| Text {
            data: data.cast(),
            length,
        };
        // SAFETY: the bytes live in this test; the other pointers are not dereferenced.
        unsafe {
            assert!(text("t", text_of(latin.as_ptr(), 1)).is_err());
            assert!(text("t", text_of(std::ptr::null(), 1)).is_err());
            assert!(text("t", text_of(latin.as_ptr(), usize::MAX)).is_err());
            assert_eq!(text("t", text_of(std::ptr::null(), 0)).expect("empty"), "");
            assert_eq!(text("t", Text::from("gel")).expect("text"), "gel");
        }
    }

    #[test]
    fn a_struct_that_is_shorter_than_it_is_known_here_is_refused() {
        let short = taceva_abi::Motion {
            size: 8,
            reserved: 0,
            target: taceva_abi::Pose {
                x: 0.0,
                y: 0.0,
                z: 0.0,
                qw: 1.0,
                qx: 0.0,
                qy: 0.0,
                qz: 0.0,
            },
            speed_m_per_s: 1.0,
        };
        // SAFETY: the struct belongs to this test.
        let refused = unsafe { sized("motion", &raw const short) }.expect_err("short");
        assert_eq!(refused.status, taceva_abi::Status::ABI);
        assert_eq!(
            refused.message,
            "`motion` has 8 bytes, expected at least 72"
        );
    }
}
