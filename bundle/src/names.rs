//! File names and `integrity` values made from a file's content.

use data_encoding::{BASE64, HEXLOWER};
use sha2::{Digest, Sha256, Sha384};

/// How many bytes of the hash go into a name: far more than two builds need to differ.
const NAME_BYTES: usize = 8;

/// `page` and `wasm` become `page-0123456789abcdef.wasm`. Another content has another name, so a
/// browser may keep each file for ever.
pub fn hashed(stem: &str, extension: &str, content: &[u8]) -> String {
    let hash = HEXLOWER.encode(&Sha256::digest(content)[..NAME_BYTES]);
    format!("{stem}-{hash}.{extension}")
}

/// The value of an `integrity` attribute for this content.
pub fn integrity(content: &[u8]) -> String {
    format!("sha384-{}", BASE64.encode(&Sha384::digest(content)))
}

/// How a policy names a script or a stylesheet that stands in the document.
pub fn sha256(content: &[u8]) -> String {
    format!("sha256-{}", BASE64.encode(&Sha256::digest(content)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_follows_the_content() {
        assert_eq!(
            hashed("page", "css", b"abc"),
            "page-ba7816bf8f01cfea.css",
            "SHA-256 of `abc` starts so (FIPS 180)"
        );
        assert_ne!(hashed("page", "css", b"abc"), hashed("page", "css", b"abd"));
    }

    #[test]
    fn integrity_is_sha384_in_base64() {
        assert_eq!(
            integrity(b"abc"),
            "sha384-ywB1P0WjXou1oD1pmsZQBycsMqsO3tFjGotgWkP/W+2AhgcroefMI1i67KE0yCWn"
        );
    }
}
