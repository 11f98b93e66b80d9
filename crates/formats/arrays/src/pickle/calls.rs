//! Values that are constructed instead of running the calls of a pickle: arrays, their types, numbers, bytes of texts.

use std::sync::Arc;

use super::machine::Machine;
use super::value::{Bytes, Content, DType, Id, PickledArray, Value};
use crate::error::Problem;
use crate::fields::Item;
use crate::limits;
use crate::scalar::{Scalar, shown};

fn unknown(at: u64, global: &str) -> Problem {
    Problem::damaged(
        at,
        format!("an unknown use of `{}`", shown(global)),
        "a use as written by NumPy",
    )
}

/// Value constructed for the call `global(*arguments)` in a pickle.
pub(crate) fn call(
    machine: &mut Machine<'_>,
    global: Id,
    arguments: Id,
    at: u64,
) -> Result<Value, Problem> {
    let (Value::Global(global), Value::Tuple(arguments)) =
        (machine.value(global), machine.value(arguments))
    else {
        return Err(Problem::damaged(
            at,
            "a call of an unknown function",
            "a function of NumPy",
        ));
    };
    let (global, arguments) = (*global, arguments.clone());
    match (global, arguments.as_slice()) {
        ("_reconstruct", _) => Ok(Value::Array(PickledArray {
            shape: Vec::new(),
            is_fortran: false,
            content: Content::Nothing,
        })),
        ("bytes", []) => Ok(Value::Bytes(Bytes::Held(Arc::new(Vec::new())))),
        ("OrderedDict", []) => Ok(Value::Dictionary(Vec::new())),
        ("dtype", [name, ..]) => {
            let name = machine.text(*name).ok_or_else(|| unknown(at, global))?;
            let is_object = name
                .trim_start_matches(['|', '<', '>', '='])
                .starts_with('O');
            Ok(Value::DType(if is_object {
                DType::Objects
            } else {
                DType::Named(name)
            }))
        }
        ("encode", [text, coding]) => encode(machine, *text, *coding, at),
        ("scalar", [dtype, bytes]) => {
            let (DType::Known(scalar), Value::Bytes(bytes)) = (
                dtype_of(machine, *dtype, at)?,
                machine.value(*bytes).clone(),
            ) else {
                return Err(unknown(at, global));
            };
            array(scalar, Vec::new(), false, bytes, at)
        }
        ("_frombuffer", [bytes, dtype, shape, order]) => {
            let (DType::Known(scalar), Value::Bytes(bytes)) = (
                dtype_of(machine, *dtype, at)?,
                machine.value(*bytes).clone(),
            ) else {
                return Err(unknown(at, global));
            };
            let shape = lengths(machine, *shape).ok_or_else(|| unknown(at, global))?;
            let is_fortran = machine.text(*order).as_deref() == Some("F");
            array(scalar, shape, is_fortran, bytes, at)
        }
        _ => Err(unknown(at, global)),
    }
}

/// Constructs the value of `object` after the call `object.__setstate__(state)` in a pickle.
pub(crate) fn build(
    machine: &mut Machine<'_>,
    object: Id,
    state: Id,
    at: u64,
) -> Result<(), Problem> {
    let Value::Tuple(state) = machine.value(state).clone() else {
        return Err(unknown(at, "__setstate__"));
    };
    let built = match (machine.value(object).clone(), state.as_slice()) {
        // Version, byte order, ...
        (Value::DType(DType::Named(name)), [_, order, ..]) => {
            let order = machine.text(*order).ok_or_else(|| unknown(at, "dtype"))?;
            let plain = name.trim_start_matches(['|', '<', '>', '=']);
            Value::DType(DType::Known(Scalar::from_numpy(&format!(
                "{order}{plain}"
            ))?))
        }
        (Value::DType(DType::Objects), _) => return Ok(()),
        // Version, shape, type, Fortran order, elements.
        (Value::Array(_), [_, shape, dtype, is_fortran, elements]) => {
            let shape = lengths(machine, *shape).ok_or_else(|| unknown(at, "ndarray"))?;
            let is_fortran = matches!(machine.value(*is_fortran), Value::Bool(true));
            match (dtype_of(machine, *dtype, at)?, machine.value(*elements)) {
                (DType::Known(scalar), Value::Bytes(bytes)) => {
                    array(scalar, shape, is_fortran, bytes.clone(), at)?
                }
                (DType::Objects, Value::List(_)) => Value::Array(PickledArray {
                    shape,
                    is_fortran,
                    content: Content::Objects(*elements),
                }),
                _ => return Err(unknown(at, "ndarray")),
            }
        }
        _ => return Err(unknown(at, "__setstate__")),
    };
    machine.values[object as usize] = built;
    Ok(())
}

/// Element type of an array, from the pickled object `dtype`. The default byte order is the order of this machine.
fn dtype_of(machine: &Machine<'_>, dtype: Id, at: u64) -> Result<DType, Problem> {
    match machine.value(dtype) {
        Value::DType(DType::Named(name)) => Scalar::from_numpy(name).map(DType::Known),
        Value::DType(dtype) => Ok(dtype.clone()),
        _ => Err(unknown(at, "dtype")),
    }
}

fn lengths(machine: &Machine<'_>, shape: Id) -> Option<Vec<u64>> {
    let length = |id: &Id| match machine.value(*id) {
        Value::Whole(length) => u64::try_from(*length).ok(),
        _ => None,
    };
    match machine.value(shape) {
        Value::Tuple(sides) if sides.len() <= limits::AXES => sides.iter().map(length).collect(),
        Value::Whole(_) => Some(vec![length(&shape)?]),
        _ => None,
    }
}

fn array(
    scalar: Scalar,
    shape: Vec<u64>,
    is_fortran: bool,
    bytes: Bytes,
    at: u64,
) -> Result<Value, Problem> {
    let item = Item::plain(scalar);
    let expected = shape
        .iter()
        .try_fold(item.bytes as u64, |bytes, side| bytes.checked_mul(*side));
    if expected != Some(bytes.length()) {
        return Err(Problem::damaged(
            at,
            format!("{} bytes for an array of shape {shape:?}", bytes.length()),
            format!("elements of {} bytes", item.bytes),
        ));
    }
    Ok(Value::Array(PickledArray {
        shape,
        is_fortran,
        content: Content::Numbers { item, bytes },
    }))
}

/// Bytes of `text` in the encoding `coding`. A pickle of protocol 2 writes bytes as Latin-1 text.
fn encode(machine: &mut Machine<'_>, text: Id, coding: Id, at: u64) -> Result<Value, Problem> {
    let coding = machine.text(coding);
    let Value::Text(letters) = machine.value(text).clone() else {
        return Err(unknown(at, "encode"));
    };
    if !matches!(coding.as_deref(), Some("latin1" | "latin-1")) {
        return Err(unknown(at, "encode"));
    }
    // Repeated encoding of one text could fill the memory.
    machine.held_bytes = machine.held_bytes.saturating_add(letters.length());
    if machine.held_bytes > machine.source.length() {
        return Err(Problem::too_large(
            "bytes of texts",
            machine.held_bytes,
            machine.source.length(),
        ));
    }
    let letters = String::from_utf8(machine.bytes(&letters)?);
    let letters = letters.map_err(|_| Problem::damaged(at, "bytes that are not text", "UTF-8"))?;
    let bytes = letters
        .chars()
        .map(|letter| u8::try_from(u32::from(letter)).ok())
        .collect::<Option<Vec<u8>>>();
    let bytes = bytes.ok_or_else(|| {
        Problem::damaged(
            at,
            "a letter beyond Latin-1",
            "bytes stored as Latin-1 letters",
        )
    })?;
    Ok(Value::Bytes(Bytes::Held(Arc::new(bytes))))
}
