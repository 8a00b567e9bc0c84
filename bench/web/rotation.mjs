// Vectors as [x, y, z] and unit quaternions as [x, y, z, w], in double precision.

export function subtract(a, b) {
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function add(a, b) {
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function multiply([ax, ay, az, aw], [bx, by, bz, bw]) {
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

export function conjugate([x, y, z, w]) {
    return [-x, -y, -z, w];
}

export function rotate([x, y, z, w], [vx, vy, vz]) {
    const tx = 2 * (y * vz - z * vy);
    const ty = 2 * (z * vx - x * vz);
    const tz = 2 * (x * vy - y * vx);
    return [vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx];
}

// Of frames { position, rotation }: `inner`, which is given in `outer`, where `outer` is given.
export function compose(outer, inner) {
    return {
        position: add(outer.position, rotate(outer.rotation, inner.position)),
        rotation: multiply(outer.rotation, inner.rotation),
    };
}

// The other way round: `frame` as seen from `from`.
export function relative(from, frame) {
    const back = conjugate(from.rotation);
    return {
        position: rotate(back, subtract(frame.position, from.position)),
        rotation: multiply(back, frame.rotation),
    };
}
