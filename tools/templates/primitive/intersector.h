// Code header: NAME. Legal in GLSL and in C++; the rules stand in shaders/shared/portable.h.

// One leaf against a ray: the first point where the ray enters the surface, with tmin <= t < tmax.
//   start, end     (x, y, z, radius) of the piece's ends, as the record holds them
//   piece, pieces  the leaf is the parameter interval [piece, piece + 1] / pieces of its curve
//   t              ray parameter: the point is origin + direction * t, the direction not being unit length
//   u              parameter on the whole curve: (piece + parameter within the piece) / pieces
//   normal         unit length, outwards, in the space of the ray
// Returns false for a miss, and whenever NaN or infinity in the arguments leaves no answer. To be written:
// until found is computed, nothing is ever hit.
FUNCTION bool NAME_intersect(real3 origin, real3 direction, real tmin, real tmax, real4 start, real4 end,
                             uint piece, uint pieces, OUT(real) t, OUT(real) u, OUT(real3) normal) {
    // In this frame the ray is the z axis, and results are as exact far from the origin as near it.
    real3 middle = (real3(end) - real3(start)) * real(0.5);
    RayFrame frame = make_ray_frame(origin, direction, real3(start), middle);
    real3 first = to_frame(frame, real3(start));
    real3 last = to_frame(frame, real3(end));

    bool found = false;
    real within = real(0);                                // parameter within the piece
    real depth = min(first.z - start.w, last.z - end.w);  // of the entry; no ball begins before this
    real3 outwards = real3(real(0), real(0), real(-1));   // normal in the frame

    t = ray_parameter(frame, depth);
    u = (real(piece) + within) / real(pieces);
    normal = from_frame(frame, outwards);
    return found && t >= tmin && t < tmax;
}
