//! Reader of FlatBuffers tables (<https://flatbuffers.dev/internals>), limited to the features that Arrow metadata uses. Offsets beyond the end of the buffer
//! give `None`.

/// FlatBuffers table. A list of offsets (vtable) locates its fields.
#[derive(Clone, Copy)]
pub(crate) struct Table<'b> {
    bytes: &'b [u8],
    at: usize,
}

/// Vector of FlatBuffers tables.
#[derive(Clone, Copy)]
pub(crate) struct Tables<'b> {
    bytes: &'b [u8],
    at: usize,
    length: usize,
}

impl<'b> Table<'b> {
    /// Root table of a buffer.
    pub(crate) fn root(bytes: &'b [u8]) -> Option<Table<'b>> {
        let at = unsigned(bytes, 0)?;
        Some(Table { bytes, at })
    }

    /// Offset of the field `number` in the buffer; `None` if the field is missing.
    fn field(self, number: usize) -> Option<usize> {
        let back = unsigned(self.bytes, self.at)?;
        let back = i32::from_le_bytes(u32::try_from(back).ok()?.to_le_bytes());
        let list = i64::try_from(self.at).ok()? - i64::from(back);
        let list = usize::try_from(list).ok()?;
        let place = 4 + 2 * number;
        let has_place = place + 2 <= usize::from(short(self.bytes, list)?);
        let offset = has_place.then(|| short(self.bytes, list.checked_add(place)?));
        match offset.flatten()? {
            0 => None,
            offset => self.at.checked_add(usize::from(offset)),
        }
    }

    pub(crate) fn byte(self, number: usize) -> Option<u8> {
        self.bytes.get(self.field(number)?).copied()
    }

    pub(crate) fn short(self, number: usize) -> Option<u16> {
        short(self.bytes, self.field(number)?)
    }

    /// Field `number`, an integer of 4 bytes; `None` if it is missing.
    pub(crate) fn integer(self, number: usize) -> Option<i32> {
        let own = self.bytes.get(self.field(number)?..)?;
        own.first_chunk().copied().map(i32::from_le_bytes)
    }

    /// Field `number`, an integer of 8 bytes; `None` if it is missing.
    pub(crate) fn long(self, number: usize) -> Option<i64> {
        let own = self.bytes.get(self.field(number)?..)?;
        own.first_chunk().copied().map(i64::from_le_bytes)
    }

    /// Bytes of the vector in the field `number`. Its elements have `size` bytes each.
    pub(crate) fn elements(self, number: usize, size: usize) -> Option<&'b [u8]> {
        let at = self.lead(number)?;
        let begin = at.checked_add(4)?;
        let bytes = unsigned(self.bytes, at)?.checked_mul(size)?;
        self.bytes.get(begin..begin.checked_add(bytes)?)
    }

    /// Offset to which the field `number` refers.
    fn lead(self, number: usize) -> Option<usize> {
        let at = self.field(number)?;
        at.checked_add(unsigned(self.bytes, at)?)
    }

    pub(crate) fn table(self, number: usize) -> Option<Table<'b>> {
        let at = self.lead(number)?;
        Some(Table { at, ..self })
    }

    pub(crate) fn text(self, number: usize) -> Option<&'b [u8]> {
        self.elements(number, 1)
    }

    pub(crate) fn tables(self, number: usize) -> Option<Tables<'b>> {
        let at = self.lead(number)?;
        Some(Tables {
            bytes: self.bytes,
            at: at.checked_add(4)?,
            length: unsigned(self.bytes, at)?,
        })
    }
}

impl<'b> Tables<'b> {
    pub(crate) fn length(self) -> usize {
        self.length
    }

    pub(crate) fn at(self, position: usize) -> Option<Table<'b>> {
        let place = position.checked_mul(4)?.checked_add(self.at)?;
        let is_there = position < self.length;
        let at = is_there.then(|| place.checked_add(unsigned(self.bytes, place)?));
        Some(Table {
            bytes: self.bytes,
            at: at.flatten()?,
        })
    }
}

fn short(bytes: &[u8], at: usize) -> Option<u16> {
    let own = bytes.get(at..at.checked_add(2)?)?;
    Some(u16::from_le_bytes(own.try_into().ok()?))
}

fn unsigned(bytes: &[u8], at: usize) -> Option<usize> {
    let own = bytes.get(at..at.checked_add(4)?)?;
    usize::try_from(u32::from_le_bytes(own.try_into().ok()?)).ok()
}
