//! Encoding of structs and enums: fields in order, without padding.

/// Implements [`Wire`](crate::child::wire::Wire) for a struct, field by field in the given order.
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

/// Implements [`Wire`](crate::child::wire::Wire) for an enum: a tag byte, then the variant's fields in the given order.
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

/// Defines enums and their encoding. Each row has the tag byte, the variant, and its fields in encoding order.
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
