//! How structs and enums are written: their fields in order, with nothing between.

/// Writes and reads a struct field by field, in the order given.
macro_rules! fields {
    ($type:ident { $($field:ident),* $(,)? }) => {
        impl $crate::child::wire::Wire for $type {
            fn write(&self, into: &mut Vec<u8>) {
                let $type { $($field),* } = self;
                $($crate::child::wire::Wire::write($field, into);)*
            }
            fn read(
                from: &mut $crate::child::wire::Reader<'_>,
            ) -> Result<$type, $crate::child::wire::Malformed> {
                Ok($type { $($field: $crate::child::wire::Wire::read(from)?),* })
            }
        }
    };
}

/// Writes and reads an enum: a byte that tells which variant it is, then its fields in the order given.
macro_rules! variants {
    ($type:ident, $expected:literal { $($tag:literal => $variant:ident { $($field:ident),* }),* $(,)? }) => {
        impl $crate::child::wire::Wire for $type {
            fn write(&self, into: &mut Vec<u8>) {
                match self {
                    $($type::$variant { $($field),* } => {
                        into.push($tag);
                        $($crate::child::wire::Wire::write($field, into);)*
                    })*
                }
            }
            fn read(
                from: &mut $crate::child::wire::Reader<'_>,
            ) -> Result<$type, $crate::child::wire::Malformed> {
                match <u8 as $crate::child::wire::Wire>::read(from)? {
                    $($tag => Ok($type::$variant {
                        $($field: $crate::child::wire::Wire::read(from)?),*
                    }),)*
                    _ => Err(from.malformed($expected)),
                }
            }
        }
    };
}

/// Defines enums and how they are written: each row is the byte that says which variant it is, the variant, and its fields in the order
/// in which they are written.
macro_rules! messages {
    ($(
        $(#[$about:meta])*
        enum $type:ident: $expected:literal {
            $($(#[$of_variant:meta])* $tag:literal => $variant:ident { $($field:ident: $of:ty),* $(,)? }),* $(,)?
        }
    )*) => {$(
        $(#[$about])*
        pub(crate) enum $type {
            $($(#[$of_variant])* $variant { $($field: $of),* }),*
        }

        $crate::child::wire::variants!($type, $expected { $($tag => $variant { $($field),* }),* });

        #[cfg(test)]
        impl $crate::child::wire::golden::Listed for $type {
            const NAME: &'static str = stringify!($type);
            const TAGS: &'static [u8] = &[$($tag),*];
        }
    )*};
}

pub(crate) use {fields, messages, variants};
