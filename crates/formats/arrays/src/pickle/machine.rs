//! Restricted pickle machine. Builds plain values and NumPy arrays, and calls nothing.

use std::collections::BTreeMap;

use super::calls::{build, call};
use super::cursor::Cursor;
use super::globals::known;
use super::value::{Bytes, Id, Value};
use crate::error::Problem;
use crate::limits;
use crate::source::{ByteSource, bytes_of};

/// State of a pickle machine: the values under construction, the stack and the memo.
#[derive(Debug)]
pub(crate) struct Machine<'a> {
    pub(crate) source: &'a dyn ByteSource,
    pub(crate) values: Vec<Value>,
    /// Number of bytes in memory that were converted from texts. The length of the file limits this number.
    pub(crate) held_bytes: u64,
    stack: Vec<Id>,
    /// Stack heights at which the open groups of values begin.
    marks: Vec<usize>,
    memo: BTreeMap<u32, Id>,
}

/// Maximum length of the name of a module, class or function, bytes.
const NAME_BYTES: usize = 1_024;

/// Runs the pickle that begins at `at`. Returns its values and the id of the result.
pub(crate) fn run(source: &dyn ByteSource, at: u64) -> Result<(Vec<Value>, Id), Problem> {
    let mut machine = Machine {
        source,
        values: Vec::new(),
        held_bytes: 0,
        stack: Vec::new(),
        marks: Vec::new(),
        memo: BTreeMap::new(),
    };
    let mut cursor = Cursor::new(source, at);
    if cursor.byte()? != 0x80 {
        return Err(Problem::unsupported(
            "not a pickle of protocol 2 to 5",
            "write it with `pickle.dump(x, file, protocol=4)`",
        ));
    }
    let protocol = cursor.byte()?;
    if !(2..=5).contains(&protocol) {
        return Err(Problem::unsupported(
            format!("a pickle of protocol {protocol}"),
            "write it with `pickle.dump(x, file, protocol=4)`",
        ));
    }
    let mut steps = 0_u64;
    loop {
        steps += 1;
        if steps > limits::PICKLE_STEPS {
            return Err(Problem::too_large(
                "steps of the pickle (save arrays instead of lists)",
                steps,
                limits::PICKLE_STEPS,
            ));
        }
        let at = cursor.at();
        let operation = cursor.byte()?;
        if operation == b'.' {
            let whole = machine.pop(at)?;
            return Ok((machine.values, whole));
        }
        machine.step(operation, at, &mut cursor)?;
    }
}

fn wrong(at: u64, what: &str) -> Problem {
    Problem::damaged(at, what, "a pickle that Python wrote")
}

impl Machine<'_> {
    pub(crate) fn pop(&mut self, at: u64) -> Result<Id, Problem> {
        let least = self.marks.last().copied().unwrap_or(0);
        if self.stack.len() <= least {
            return Err(wrong(at, "an operation without its value"));
        }
        self.stack
            .pop()
            .ok_or_else(|| wrong(at, "an operation without its value"))
    }

    fn top(&self, at: u64) -> Result<Id, Problem> {
        let least = self.marks.last().copied().unwrap_or(0);
        let top = self.stack.last().filter(|_| self.stack.len() > least);
        top.copied()
            .ok_or_else(|| wrong(at, "an operation without its value"))
    }

    /// Pops the last mark and the stack values above it.
    fn group(&mut self, at: u64) -> Result<Vec<Id>, Problem> {
        let height = self
            .marks
            .pop()
            .filter(|height| *height <= self.stack.len());
        height
            .map(|height| self.stack.split_off(height))
            .ok_or_else(|| wrong(at, "a group without a beginning"))
    }

    /// Pops the last `count` values of the stack.
    fn last(&mut self, count: usize, at: u64) -> Result<Vec<Id>, Problem> {
        let least = self.marks.last().copied().unwrap_or(0);
        let height = self
            .stack
            .len()
            .checked_sub(count)
            .filter(|height| *height >= least);
        height
            .map(|height| self.stack.split_off(height))
            .ok_or_else(|| wrong(at, "a tuple without its values"))
    }

    pub(crate) fn push(&mut self, value: Value) -> Result<(), Problem> {
        let count = self.values.len() as u64;
        let id = Id::try_from(count)
            .ok()
            .filter(|_| count < limits::PICKLED_VALUES);
        let id = id.ok_or_else(|| {
            Problem::too_large(
                "values of the pickle (save arrays instead of lists)",
                count + 1,
                limits::PICKLED_VALUES,
            )
        })?;
        self.values.push(value);
        self.again(id)
    }

    fn again(&mut self, id: Id) -> Result<(), Problem> {
        if self.stack.len() as u64 >= limits::PICKLED_VALUES {
            return Err(Problem::too_large(
                "values on the stack of the pickle",
                self.stack.len() as u64 + 1,
                limits::PICKLED_VALUES,
            ));
        }
        self.stack.push(id);
        Ok(())
    }

    pub(crate) fn value(&self, id: Id) -> &Value {
        &self.values[id as usize]
    }

    /// Content of a short text; `None` for other values.
    pub(crate) fn text(&self, id: Id) -> Option<String> {
        match self.value(id) {
            Value::Text(bytes) if bytes.length() <= NAME_BYTES as u64 => {
                String::from_utf8(self.bytes(bytes).ok()?).ok()
            }
            _ => None,
        }
    }

    pub(crate) fn bytes(&self, bytes: &Bytes) -> Result<Vec<u8>, Problem> {
        read(self.source, bytes)
    }

    fn remember(&mut self, key: u32, at: u64) -> Result<(), Problem> {
        let id = self.top(at)?;
        self.memo.insert(key, id);
        let count = self.memo.len() as u64;
        if count > limits::PICKLED_VALUES {
            return Err(Problem::too_large(
                "memo entries of the pickle",
                count,
                limits::PICKLED_VALUES,
            ));
        }
        Ok(())
    }

    fn recall(&mut self, key: u32, at: u64) -> Result<(), Problem> {
        let id = self
            .memo
            .get(&key)
            .copied()
            .ok_or_else(|| wrong(at, "a memo entry that was never stored"))?;
        self.again(id)
    }

    fn global(&mut self, module: &str, name: &str, at: u64) -> Result<(), Problem> {
        let global = known(module, name, at)?;
        self.push(Value::Global(global))
    }

    /// Pushes the location of bytes or text of `length` bytes, without reading them.
    fn long(&mut self, length: u64, is_text: bool, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let bytes = Bytes::InFile {
            at: cursor.pass(length)?,
            length,
        };
        self.push(if is_text {
            Value::Text(bytes)
        } else {
            Value::Bytes(bytes)
        })
    }

    fn step(&mut self, operation: u8, at: u64, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        match operation {
            // A frame states its length. The length is not needed.
            0x95 => cursor.few::<8>().map(|_| ()),
            b'(' => {
                self.marks.push(self.stack.len());
                if self.marks.len() > limits::PICKLE_DEPTH {
                    return Err(Problem::too_large(
                        "nested groups of the pickle",
                        self.marks.len() as u64,
                        limits::PICKLE_DEPTH as u64,
                    ));
                }
                Ok(())
            }
            b'0' => self.pop(at).map(|_| ()),
            b'1' => self.group(at).map(|_| ()),
            b'2' => self.top(at).and_then(|id| self.again(id)),
            b'N' => self.push(Value::None),
            0x88 | 0x89 => self.push(Value::Bool(operation == 0x88)),
            b'J' => i32::from_le_bytes(cursor.few()?)
                .pipe(|number| self.push(Value::Whole(number.into()))),
            b'K' => cursor
                .byte()?
                .pipe(|number| self.push(Value::Whole(number.into()))),
            b'M' => u16::from_le_bytes(cursor.few()?)
                .pipe(|number| self.push(Value::Whole(number.into()))),
            0x8a => self.whole(at, cursor),
            b'G' => {
                f64::from_be_bytes(cursor.few()?).pipe(|number| self.push(Value::Float(number)))
            }
            0x8c => cursor
                .length::<1>()?
                .pipe(|length| self.long(length, true, cursor)),
            b'X' => cursor
                .length::<4>()?
                .pipe(|length| self.long(length, true, cursor)),
            0x8d => cursor
                .length::<8>()?
                .pipe(|length| self.long(length, true, cursor)),
            b'C' | b'U' => cursor
                .length::<1>()?
                .pipe(|length| self.long(length, false, cursor)),
            b'B' | b'T' => cursor
                .length::<4>()?
                .pipe(|length| self.long(length, false, cursor)),
            0x8e | 0x96 => cursor
                .length::<8>()?
                .pipe(|length| self.long(length, false, cursor)),
            b']' => self.push(Value::List(Vec::new())),
            b'}' => self.push(Value::Dictionary(Vec::new())),
            b')' => self.push(Value::Tuple(Vec::new())),
            b't' => self
                .group(at)?
                .pipe(|values| self.push(Value::Tuple(values))),
            0x85..=0x87 => self
                .last(usize::from(operation - 0x84), at)?
                .pipe(|values| self.push(Value::Tuple(values))),
            b'a' => self.pop(at)?.pipe(|value| self.append(vec![value], at)),
            b'e' => self.group(at)?.pipe(|values| self.append(values, at)),
            b's' => self.last(2, at)?.pipe(|pair| self.insert(&pair, at)),
            b'u' => self.group(at)?.pipe(|pairs| self.insert(&pairs, at)),
            0x94 => u32::try_from(self.memo.len())
                .unwrap_or(u32::MAX)
                .pipe(|key| self.remember(key, at)),
            b'q' => u32::from(cursor.byte()?).pipe(|key| self.remember(key, at)),
            b'r' => u32::from_le_bytes(cursor.few()?).pipe(|key| self.remember(key, at)),
            b'h' => u32::from(cursor.byte()?).pipe(|key| self.recall(key, at)),
            b'j' => u32::from_le_bytes(cursor.few()?).pipe(|key| self.recall(key, at)),
            b'c' => {
                let (module, name) = (cursor.line(NAME_BYTES)?, cursor.line(NAME_BYTES)?);
                self.global(&module, &name, at)
            }
            0x93 => {
                let pair = self.last(2, at)?;
                let (module, name) = (self.text(pair[0]), self.text(pair[1]));
                match (module, name) {
                    (Some(module), Some(name)) => self.global(&module, &name, at),
                    _ => Err(wrong(at, "a global without a name")),
                }
            }
            b'R' | 0x81 => {
                let pair = self.last(2, at)?;
                let made = call(self, pair[0], pair[1], at)?;
                self.push(made)
            }
            b'b' => {
                let state = self.pop(at)?;
                let of = self.top(at)?;
                build(self, of, state, at)
            }
            0x97 | 0x98 => Err(Problem::unsupported(
                "buffers outside the pickle",
                "write it without `buffer_callback`",
            )),
            0x8f..=0x91 => Err(Problem::unsupported(
                "a set, which has no order",
                "write a list",
            )),
            b'P' | b'Q' => Err(Problem::unsupported(
                "a reference outside the pickle, as written by `torch.save`",
                "write `np.savez('run.npz', x=x.numpy())`",
            )),
            other => Err(wrong(at, &format!("operation {other:#04x}"))),
        }
    }

    /// Pushes a whole number of at most 8 bytes. The number of bytes precedes them.
    fn whole(&mut self, at: u64, cursor: &mut Cursor<'_>) -> Result<(), Problem> {
        let count = cursor.byte()?;
        if count > 8 {
            return Err(Problem::unsupported(
                format!("a whole number of {count} bytes at byte {at}"),
                "write numbers of 64 bits",
            ));
        }
        let mut bytes = [0; 8];
        for byte in bytes.iter_mut().take(usize::from(count)) {
            *byte = cursor.byte()?;
        }
        if count > 0 && bytes[usize::from(count) - 1] & 0x80 != 0 {
            bytes[usize::from(count)..].fill(0xff);
        }
        self.push(Value::Whole(i64::from_le_bytes(bytes)))
    }

    fn append(&mut self, more: Vec<Id>, at: u64) -> Result<(), Problem> {
        let list = self.top(at)?;
        match &mut self.values[list as usize] {
            Value::List(values) => {
                values.extend(more);
                Ok(())
            }
            _ => Err(wrong(at, "an element for a value that is not a list")),
        }
    }

    fn insert(&mut self, pairs: &[Id], at: u64) -> Result<(), Problem> {
        let dictionary = self.top(at)?;
        match &mut self.values[dictionary as usize] {
            Value::Dictionary(entries) => {
                entries.extend(
                    pairs
                        .as_chunks::<2>()
                        .0
                        .iter()
                        .map(|[key, value]| (*key, *value)),
                );
                Ok(())
            }
            _ => Err(wrong(at, "an entry for a value that is not a dictionary")),
        }
    }
}

pub(crate) fn read(source: &dyn ByteSource, bytes: &Bytes) -> Result<Vec<u8>, Problem> {
    match bytes {
        Bytes::InFile { at, length } => bytes_of(source, *at, *length),
        Bytes::Held(bytes) => Ok(bytes.to_vec()),
    }
}

/// Function call in postfix form, so that each operation is one line.
trait Pipe: Sized {
    fn pipe<T>(self, next: impl FnOnce(Self) -> T) -> T {
        next(self)
    }
}

impl<V> Pipe for V {}
