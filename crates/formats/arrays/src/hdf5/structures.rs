//! Structures of an HDF5 file as bytes, for the writer: superblock and object headers of version 2, and header messages.

use super::element_type::WrittenElement;
use super::lookup3::lookup3;

/// Size of the superblock, bytes. The first array follows the superblock.
pub(super) const SUPERBLOCK_BYTES: usize = 48;
/// Address that marks missing content in HDF5.
pub(super) const NOWHERE: u64 = u64::MAX;

/// Layout message for contiguous elements of `bytes` bytes at the offset `at`.
pub(super) fn contiguous(at: u64, bytes: u64) -> Vec<u8> {
    let at = if bytes == 0 { NOWHERE } else { at };
    [&[3, 1][..], &at.to_le_bytes(), &bytes.to_le_bytes()].concat()
}

/// Dataspace message of a fixed shape. An empty shape means one element.
pub(super) fn dataspace(shape: &[u64]) -> Vec<u8> {
    let rank = u8::try_from(shape.len()).unwrap_or(u8::MAX);
    let mut message = vec![2, rank, 0, u8::from(rank > 0)];
    message.extend(shape.iter().flat_map(|side| side.to_le_bytes()));
    message
}

/// Global heap collection of HDF5: a header, then one object for each text of an attribute. HDF5 libraries thus read texts and not bytes.
#[derive(Debug, Default)]
pub(super) struct Heap {
    objects: Vec<u8>,
    pub(super) count: u16,
}

/// Size of the header of a heap collection, bytes. The header of an object in the collection has the same size.
const HEAP_HEADER: usize = 16;
/// Minimum size of a heap collection, bytes.
const HEAP_LEAST: usize = 4096;

impl Heap {
    /// Adds a text. Returns the number of its object, from 1.
    pub(super) fn add(&mut self, text: &str) -> u16 {
        self.count += 1;
        self.objects.extend(self.count.to_le_bytes());
        // Reference count 1.
        self.objects.extend([1, 0, 0, 0, 0, 0]);
        self.objects.extend((text.len() as u64).to_le_bytes());
        self.objects.extend(text.as_bytes());
        self.objects
            .resize(self.objects.len().next_multiple_of(8), 0);
        self.count
    }

    /// Bytes of the collection. Its free space is an object with number 0.
    pub(super) fn collection(mut self) -> Vec<u8> {
        let used = HEAP_HEADER + self.objects.len();
        let size = (used + HEAP_HEADER).max(HEAP_LEAST);
        let mut collection = b"GCOL\x01\0\0\0".to_vec();
        collection.extend((size as u64).to_le_bytes());
        collection.append(&mut self.objects);
        collection.extend([0; 8]);
        collection.extend(((size - used) as u64).to_le_bytes());
        collection.resize(size, 0);
        collection
    }
}

/// Attribute message of a text of `bytes` bytes, which is the object `object` in the heap at `heap`.
pub(super) fn attribute(key: &str, bytes: usize, heap: u64, object: u16) -> (u8, Vec<u8>) {
    // Variable-length UTF-8 text: a length, and a reference; base type bytes.
    let mut kind = vec![0x19, 0x01, 0x01, 0, 16, 0, 0, 0];
    kind.extend(WrittenElement::U8.message());
    let space = dataspace(&[]);
    let size = |bytes: usize| u16::try_from(bytes).unwrap_or(u16::MAX).to_le_bytes();
    let mut message = vec![3, 0];
    message.extend(size(key.len() + 1));
    message.extend(size(kind.len()));
    message.extend(size(space.len()));
    // The name is UTF-8.
    message.push(1);
    message.extend(key.as_bytes());
    message.push(0);
    message.extend(kind);
    message.extend(space);
    message.extend(u32::try_from(bytes).unwrap_or(u32::MAX).to_le_bytes());
    message.extend(heap.to_le_bytes());
    message.extend(u32::from(object).to_le_bytes());
    (0x0c, message)
}

/// Message for a link `name` to the object header at the offset `at`.
pub(super) fn link(name: &str, at: u64) -> Vec<u8> {
    let length = u8::try_from(name.len()).unwrap_or(u8::MAX);
    let mut message = vec![1, 0x10, 1, length];
    message.extend(name.as_bytes());
    message.extend(at.to_le_bytes());
    message
}

/// Object header with `messages`, each with its type.
pub(super) fn header(messages: &[(u8, Vec<u8>)]) -> Vec<u8> {
    let mut body = Vec::new();
    for (number, message) in messages {
        body.push(*number);
        body.extend(
            u16::try_from(message.len())
                .unwrap_or(u16::MAX)
                .to_le_bytes(),
        );
        body.push(0);
        body.extend(message);
    }
    // Version 2. The length has four bytes.
    let mut header = b"OHDR\x02\x02".to_vec();
    header.extend(u32::try_from(body.len()).unwrap_or(u32::MAX).to_le_bytes());
    header.extend(body);
    header.extend(lookup3(&header).to_le_bytes());
    header
}

/// Superblock of a file of `end` bytes whose root group is at `root`.
pub(super) fn superblock(end: u64, root: u64) -> Vec<u8> {
    // Version 2. Addresses and lengths have eight bytes.
    let mut block = b"\x89HDF\r\n\x1a\n\x02\x08\x08\x00".to_vec();
    for address in [0, NOWHERE, end, root] {
        block.extend(address.to_le_bytes());
    }
    block.extend(lookup3(&block).to_le_bytes());
    block
}
