//! The resolution of a picture, so that programs print it at its true size.

/// Bytes before the first optional chunk: signature and image header.
const HEADER: usize = 8 + 25;

/// Adds the chunk `pHYs` (PNG specification, section 11.3.4.3) to an encoded picture.
pub(super) fn stated(mut png: Vec<u8>, pixels_per_inch: f64) -> Vec<u8> {
    const METRES_PER_INCH: f64 = 0.0254;
    let per_metre = (pixels_per_inch / METRES_PER_INCH).round() as u32;
    let mut body = b"pHYs".to_vec();
    body.extend(per_metre.to_be_bytes());
    body.extend(per_metre.to_be_bytes());
    // The unit is the metre.
    body.push(1);
    let length = (body.len() - 4) as u32;
    let mut chunk = length.to_be_bytes().to_vec();
    chunk.extend(&body);
    chunk.extend(checksum(&body).to_be_bytes());
    if png.len() > HEADER {
        png.splice(HEADER..HEADER, chunk);
    }
    png
}

/// The cyclic redundancy check of PNG (its specification, annex D), bit by bit.
fn checksum(bytes: &[u8]) -> u32 {
    let shift = |register: u32| {
        let carry = if register & 1 == 1 { 0xedb8_8320 } else { 0 };
        carry ^ (register >> 1)
    };
    let step = |register: u32, byte: &u8| {
        (0..8).fold(register ^ u32::from(*byte), |register, _| shift(register))
    };
    !bytes.iter().fold(u32::MAX, step)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oracle: the check value of CRC-32 that every description of it gives, and the checksum of the
    /// end chunk that every PNG file ends with.
    #[test]
    fn the_checksum_is_that_of_png() {
        assert_eq!(checksum(b"123456789"), 0xcbf4_3926);
        assert_eq!(checksum(b"IEND"), 0xae42_6082);
    }
}
