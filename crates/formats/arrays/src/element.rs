//! Element types and shapes of arrays, as stated in the file.

/// Type of the elements of an array. Widths are in bits.
///
/// ```
/// use taceva_arrays::Element;
///
/// assert_eq!(Element::Float(16).to_string(), "16 bit floating point");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Element {
    /// True or false.
    Bool,
    /// Whole numbers without a sign, of 8, 16, 32 or 64 bits.
    Unsigned(u8),
    /// Whole numbers with a sign, of 8, 16, 32 or 64 bits.
    Signed(u8),
    /// IEEE 754 floating-point numbers of 16, 32 or 64 bits.
    Float(u8),
    /// Variable-length text.
    Text,
    /// Bytes of any length for each element, such as an encoded picture.
    Bytes,
}

impl std::fmt::Display for Element {
    fn fmt(&self, into: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Element::Bool => into.write_str("true or false"),
            Element::Unsigned(bits) => write!(into, "{bits} bit unsigned"),
            Element::Signed(bits) => write!(into, "{bits} bit signed"),
            Element::Float(bits) => write!(into, "{bits} bit floating point"),
            Element::Text => into.write_str("text"),
            Element::Bytes => into.write_str("bytes"),
        }
    }
}

/// Shape and type of one array, known without reading its elements.
///
/// ```no_run
/// # fn of(file: &taceva_arrays::ArrayFile) {
/// let frames = file.info("/camera/rgb").expect("it is there");
/// assert_eq!(frames.shape, [20_000, 240, 320, 3]);
/// assert_eq!(frames.rows(), 20_000);
/// assert_eq!(frames.row_elements(), Some(240 * 320 * 3));
/// # }
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ArrayInfo {
    /// Lengths of the axes, the slowest axis first; empty for a single number.
    pub shape: Vec<u64>,
    /// Type of the elements.
    pub element: Element,
}

impl ArrayInfo {
    pub(crate) fn new(shape: Vec<u64>, element: Element) -> ArrayInfo {
        ArrayInfo { shape, element }
    }

    /// Length of the first axis; 1 for a single number.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.shape.first().copied().unwrap_or(1)
    }

    /// Number of elements of one row: the product of all axes except the first. `None` if it exceeds 64 bits.
    #[must_use]
    pub fn row_elements(&self) -> Option<u64> {
        let rest = self.shape.get(1..).unwrap_or(&[]);
        rest.iter()
            .try_fold(1_u64, |product, side| product.checked_mul(*side))
    }
}
