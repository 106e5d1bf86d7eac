//! The GUID: a fingerprint of an interface, the same in the XML and in the binary.

use sha2::{Digest, Sha256};
use ttb_contract::Interface;

/// GUID `{8-4-4-4-12}` of an interface: the SHA-256 of its canonical text, cut to a version-8 UUID.
///
/// Any change of a name, type, unit, causality, start value or of this program's version gives another one, so that
/// value references of another list are never used.
pub fn guid(model_identifier: &str, interface: &Interface) -> String {
    let digest = Sha256::digest(canonical_text(model_identifier, interface));
    let mut bytes: [u8; 16] = std::array::from_fn(|i| digest[i]);
    bytes[6] = bytes[6] & 0x0f | 0x80; // UUID version 8: free form
    bytes[8] = bytes[8] & 0x3f | 0x80; // RFC 9562 variant
    let hex = |range: std::ops::Range<usize>| bytes[range].iter().map(|b| format!("{b:02x}")).collect::<String>();
    format!("{{{}-{}-{}-{}-{}}}", hex(0..4), hex(4..6), hex(6..8), hex(8..10), hex(10..16))
}

/// One line per variable; `{:?}` of a name or of items quotes line breaks, so that no two interfaces share a text.
fn canonical_text(model_identifier: &str, interface: &Interface) -> String {
    let mut text = format!("ttb {} {model_identifier}\n", env!("CARGO_PKG_VERSION"));
    for v in interface.variables() {
        let start = v.start.to_bits();
        text += &format!("{:?} {:?} {:?} {start:016x} {}\n", v.name, v.causality, v.kind, v.feed_through);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use ttb_contract::Variable;

    fn interface(unit: &'static str, start: f64) -> Interface {
        let input = Variable::input("support[1].force", unit, "any text");
        Interface::new(vec![input], vec![], vec![Variable::parameter("speed", "m/s", start, "")])
    }

    #[test]
    fn a_guid_has_the_registry_form() {
        let guid = guid("Bridge", &interface("N", 1.0));
        let groups: Vec<usize> = guid.trim_matches(['{', '}']).split('-').map(str::len).collect();
        assert_eq!((guid.len(), groups), (38, vec![8, 4, 4, 4, 12]));
        assert!(guid.starts_with('{') && guid.ends_with('}'));
    }

    #[test]
    fn a_guid_changes_with_identifier_unit_and_start_and_with_nothing_else() {
        let guids = [
            guid("Bridge", &interface("N", 1.0)),
            guid("TrainTrack", &interface("N", 1.0)),
            guid("Bridge", &interface("kg", 1.0)),
            guid("Bridge", &interface("N", 1.0 + f64::EPSILON)),
        ];
        for (i, a) in guids.iter().enumerate() {
            assert!(guids[..i].iter().all(|b| a != b));
        }
        assert_eq!(guids[0], guid("Bridge", &interface("N", 1.0)));
    }
}
